// SPDX-License-Identifier: Apache-2.0
//
// Decodes a mesh stream of any bytes, given as a case: its parameters, the BIN chunk with the arrays of its coarsest
// level, then the payloads. The mesh can be drawn after every payload.
#include "lightwell/base/assert.h"
#include "lightwell/mesh/base_places.h"
#include "tests/cases/case.h"

using namespace lightwell;

namespace {

// Large meshes would only slow the search down.
constexpr uint32_t most_vertices = 4096, most_faces = 8192;
constexpr uint64_t any_length = uint64_t(1) << 40;
/// Longer ones have regions, as those of mesh_codec_regions.
constexpr size_t parameters_without_regions = 53;

void draw(const MeshDecoder& decoder) {
  LW_ASSERT(decoder.vertices() <= decoder.positions().size());
  size_t faces = 0;
  for (size_t region = 0; region < decoder.layout().region_count(); region++) {
    for (const uint32_t v : decoder.indices(region)) LW_ASSERT(v < decoder.vertices());
    faces += decoder.indices(region).size() / 3;
  }
  LW_ASSERT(faces == decoder.faces());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  ByteReader reader({data, size});
  const Case one = read_case(reader);
  if (one.parts.size() < 2) return 0;
  const auto parameters = MeshParameters::read(one.parts[0], one.parts[0].size() > parameters_without_regions);
  if (!parameters) return 0;
  const MeshLayout& layout = parameters->layout;
  if (layout.vertices > most_vertices || layout.faces > most_faces) return 0;
  const auto base = BaseArrays::read(layout, parameters->places, one.parts[1]);
  if (!base) return 0;
  auto decoder = MeshDecoder::open(layout, base->view(), any_length);
  if (!decoder) return 0;
  draw(*decoder);
  for (size_t i = 2; i < one.parts.size(); i++) {
    const bool intact = decoder->append(one.parts[i]).has_value();
    draw(*decoder);
    decoder->take_changes();
    if (!intact) break;
  }
  return 0;
}
