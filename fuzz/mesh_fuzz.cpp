// SPDX-License-Identifier: Apache-2.0
//
// A mesh stream of any bytes: a layout, the arrays of its coarsest level, then payloads of a length byte's size
// times 16. What the decoder takes can be drawn after every payload.
#include "lightwell/base/assert.h"
#include "lightwell/mesh/base_places.h"

using namespace lightwell;

namespace {

// Large meshes would only slow the search down.
constexpr uint32_t most_vertices = 4096, most_faces = 8192;
constexpr uint64_t any_length = uint64_t(1) << 40;

void draw(const MeshDecoder& decoder) {
  LW_ASSERT(decoder.vertices() <= decoder.positions().size());
  LW_ASSERT(3 * size_t(decoder.faces()) <= decoder.indices().size());
  for (uint32_t i = 0; i < 3 * decoder.faces(); i++) LW_ASSERT(decoder.indices()[i] < decoder.vertices());
}

// The places of arrays that follow one another.
BasePlaces packed(const MeshLayout& layout) {
  BasePlaces places;
  uint32_t at = 0;
  const auto next = [&](bool present, uint32_t bytes) {
    return std::exchange(at, at + (present ? bytes * layout.base_vertices : 0));
  };
  places.positions = next(true, 12);
  places.normals = next(layout.has_normals, 12);
  for (size_t set = 0; set < 2; set++) places.texcoords[set] = next(layout.has_texcoords[set], 8);
  places.colors = next(layout.has_colors, 4);
  places.indices = at;
  places.short_indices = true;
  return places;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const Bytes input(data, size);
  ByteReader reader(input);
  const auto layout = MeshLayout::read(reader);
  if (!layout || layout->vertices > most_vertices || layout->faces > most_faces) return 0;
  const BasePlaces places = packed(*layout);
  const auto base = BaseArrays::read(*layout, places, input.subspan(reader.position()));
  if (!base) return 0;
  auto decoder = MeshDecoder::open(*layout, base->view(), any_length);
  if (!decoder) return 0;
  draw(*decoder);

  reader.take(places.indices + size_t(6) * layout->base_faces);
  while (reader.remaining() > 0) {
    const size_t length = std::min<size_t>(16 * size_t(reader.u8()), reader.remaining());
    const bool intact = decoder->append(reader.take(length)).has_value();
    draw(*decoder);
    decoder->take_changes();
    if (!intact) break;
  }
  return 0;
}
