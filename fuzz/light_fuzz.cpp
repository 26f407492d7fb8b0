// SPDX-License-Identifier: Apache-2.0
//
// A light stream of any bytes: the parameters, then payloads of a length byte's size times 16. Whatever is accepted can
// be filled, looked up and put into an atlas.
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/light/atlas.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/light/stream.h"

using namespace lightwell;

namespace {

// Large grids would only slow the search down.
constexpr size_t most_nodes = 4096;

void draw(const LightDecoder& decoder) {
  LightGrid grid = decoder.grid();
  push_pull(grid, decoder.known(), Fill::push_pull_smooth);
  LW_ASSERT(is_finite(grid.irradiance(grid.shape.lo, {{0, 1, 0}})));
  LightAtlas(grid.shape, AtlasForm::patched, grid.normal_offset, decoder.layout().scale).update(grid);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  ByteWriter writer;
  LightLayout().write(writer);
  const size_t parameters = writer.size();

  const Bytes input(data, size);
  const Bytes head = input.first(std::min(parameters, size));
  const auto layout = LightLayout::read(head);
  if (!layout || layout->shape.count() > most_nodes) return 0;
  auto decoder = LightDecoder::open(head);
  LW_ASSERT(decoder);
  draw(*decoder);

  ByteReader reader(input.subspan(parameters));
  while (reader.remaining() > 0) {
    const size_t length = std::min<size_t>(16 * size_t(reader.u8()), reader.remaining());
    const size_t before = decoder->received();
    if (!decoder->append(reader.take(length))) LW_ASSERT(decoder->received() == before);
  }
  draw(*decoder);
  return 0;
}
