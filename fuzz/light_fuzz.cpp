// SPDX-License-Identifier: Apache-2.0
//
// Decodes a light stream of any bytes, given as a case: the parameters, then the payloads. Whatever is accepted can be
// filled, looked up and put into an atlas.
#include "lightwell/base/assert.h"
#include "lightwell/light/atlas.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/light/stream.h"
#include "tests/cases/case.h"

using namespace lightwell;

namespace {

// Large grids would only slow the search down.
constexpr size_t most_nodes = 512;
constexpr uint64_t any_length = uint64_t(1) << 40;

void draw(const LightDecoder& decoder) {
  LightGrid grid = decoder.grid();
  push_pull(grid, decoder.known(), Fill::push_pull_smooth);
  LW_ASSERT(is_finite(grid.irradiance(grid.shape.lo, {{0, 1, 0}})));
  LightAtlas(grid.shape, grid.normal_offset, decoder.layout().scale).update(grid);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  ByteReader reader({data, size});
  const Case one = read_case(reader);
  if (one.parts.empty()) return 0;
  const auto layout = LightLayout::read(one.parts[0]);
  if (!layout || layout->shape.count() > most_nodes) return 0;
  auto decoder = LightDecoder::open(one.parts[0], any_length);
  LW_ASSERT(decoder);
  draw(*decoder);
  for (size_t i = 1; i < one.parts.size(); i++) {
    const size_t before = decoder->received();
    if (!decoder->append(one.parts[i])) LW_ASSERT(decoder->received() == before);
  }
  draw(*decoder);
  return 0;
}
