// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/stream_head.h"

#include <cmath>

#include "lightwell/base/power_of_two.h"
#include "lightwell/light/stream.h"

namespace lightwell {

void write_shape(ByteWriter& writer, const GridShape& shape) {
  for (const float v : shape.lo.e) writer.f32(v);
  for (const float v : shape.cell.e) writer.f32(v);
  for (const int n : shape.nodes.e) writer.u16(static_cast<uint16_t>(n));
}

GridShape read_shape(ByteReader& reader) {
  GridShape shape;
  for (float& v : shape.lo.e) v = reader.f32();
  for (float& v : shape.cell.e) v = reader.f32();
  for (int& n : shape.nodes.e) n = reader.u16();
  return shape;
}

Result<void> check_head(const GridShape& shape, float normal_offset, float scale) {
  for (int a = 0; a < 3; a++) {
    if (shape.nodes[a] < 2 || shape.nodes[a] > LightLayout::most_nodes_an_axis)
      return fail("light parameters", "number of nodes out of range");
    if (!(shape.cell[a] > 0)) return fail("light parameters", "cell is not positive");
  }
  if (shape.count() > LightLayout::most_nodes) return fail(ErrorKind::limit, "light parameters", "too many nodes");
  if (!is_finite(shape.lo) || !is_finite(shape.hi())) return fail("light parameters", "place is not finite");
  if (!(std::abs(normal_offset) <= 1)) return fail("light parameters", "normal offset out of range");
  if (!is_power_of_two(scale)) return fail("light parameters", "scale is not a power of two");
  if (scale < 0x1p-11f || scale > 0x1p15f) return fail("light parameters", "scale out of range");
  return {};
}

}  // namespace lightwell
