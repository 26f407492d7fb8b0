// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "lightwell/base/model_coder.h"
#include "lightwell/base/power_of_two.h"
#include "lightwell/light/stream.h"

namespace lightwell {
Result<LightLayout> LightLayout::read(Bytes parameters) {
  ByteReader reader(parameters);
  LightLayout layout;
  for (float& v : layout.shape.lo.e) v = reader.f32();
  for (float& v : layout.shape.cell.e) v = reader.f32();
  for (int& n : layout.shape.nodes.e) n = reader.u16();
  layout.nodes_per_slice = reader.u16();
  layout.normal_offset = reader.f32();
  layout.scale = reader.f32();
  layout.seed = reader.u64();
  for (MomentsRecord& corner : layout.corners) corner = MomentsRecord::read(reader);
  if (!reader.ok() || reader.remaining() != 0) return fail("light parameters", "wrong length");

  for (int a = 0; a < 3; a++) {
    const int n = layout.shape.nodes[a];
    if (n < 2 || n > most_nodes_an_axis) return fail("light parameters", "number of nodes out of range");
    if (!(layout.shape.cell[a] > 0)) return fail("light parameters", "cell is not positive");
  }
  if (layout.shape.count() > most_nodes) return fail(ErrorKind::limit, "light parameters", "too many nodes");
  if (!is_finite(layout.shape.lo) || !is_finite(layout.shape.hi()))
    return fail("light parameters", "place is not finite");
  if (layout.nodes_per_slice < 1 || layout.nodes_per_slice > 1024)
    return fail("light parameters", "nodes of a slice out of range");
  if (!(std::abs(layout.normal_offset) <= 1)) return fail("light parameters", "normal offset out of range");
  if (!is_power_of_two(layout.scale)) return fail("light parameters", "scale is not a power of two");
  if (layout.scale < 0x1p-11f || layout.scale > 0x1p15f) return fail("light parameters", "scale out of range");
  return layout;
}

LightDecoder::LightDecoder(const LightLayout& layout)
    : layout_(layout),
      order_(light_order(layout.shape, layout.seed, layout.nodes_per_slice)),
      records_(layout.shape),
      coder_(std::make_unique<RecordCoder>()) {
  grid_.shape = layout.shape;
  grid_.normal_offset = layout.normal_offset;
  grid_.moments.resize(layout.shape.count());
  grid_.valid.assign(layout.shape.count(), 1);
  const std::array<size_t, 8> corners = corner_nodes(layout.shape);
  for (size_t i = 0; i < 8; i++) {
    records_.set(corners[i], layout.corners[i]);
    publish(corners[i]);
  }
}

Result<LightDecoder> LightDecoder::open(Bytes parameters, uint64_t stream_bytes) {
  LW_TRY(layout, LightLayout::read(parameters));
  if ((layout.shape.count() - layout.corners.size()) / light_nodes_per_byte > stream_bytes)
    return fail("light parameters", "promise more nodes than the stream's bytes can hold");
  return LightDecoder(layout);
}

Result<void> LightDecoder::append(Bytes payload) {
  if (complete()) return fail("light bundle", "the grid is complete already");
  const size_t end = order_.ends[bundle_];
  auto coder = std::make_unique<RecordCoder>(*coder_);
  ModelReader reader(payload);
  for (size_t i = at_; i < end; i++) {
    MomentsRecord record;
    coder->code(reader, record, records_, order_.nodes[i]);
    records_.set(order_.nodes[i], record);
  }
  if (reader.overrun()) {
    for (size_t i = at_; i < end; i++) records_.forget(order_.nodes[i]);
    return fail("light bundle", "ends too early");
  }
  for (; at_ < end; at_++) publish(order_.nodes[at_]);
  coder_ = std::move(coder);
  bundle_++;
  return {};
}

// Writes the decoded record of a node to the grid. 1 / scale is exact, since the scale is a power of two.
void LightDecoder::publish(size_t node) {
  grid_.moments[node] = decode_record(records_[node]) * (1 / layout_.scale);
  grid_.valid[node] = records_[node].valid();
}

}  // namespace lightwell
