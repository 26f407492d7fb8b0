// SPDX-License-Identifier: Apache-2.0
//
// Decodes a stream of any kind, codec and bytes, given as a case (tests/asset/asset_case.h), with a small memory
// budget: the ranges that it delivers lie inside the buffers that it has announced.
#include "lightwell/base/assert.h"
#include "tests/asset/asset_case.h"

using namespace lightwell;

namespace {

// Large buffers would only slow the search down.
constexpr uint64_t most_bytes = 500000;
constexpr size_t piece_bytes = 64;

void take_all(AssetDecoder& decoder, const MeshUpdate& mesh) {
  while (const auto update = decoder.take(piece_bytes)) {
    const auto* range = std::get_if<RangeUpdate>(&*update);
    if (!range) continue;
    const bool indices = range->buffer == RangeUpdate::indices;
    LW_ASSERT(indices || range->buffer < mesh.attributes.size());
    const uint64_t size =
        indices ? uint64_t(12) * mesh.faces : uint64_t(mesh.attributes[range->buffer].stride) * mesh.vertices;
    LW_ASSERT(range->offset + range->data.size() <= size);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  ByteReader reader({data, size});
  const Case one = read_case(reader);
  AssetContext context;
  context.budget = most_bytes;
  if (one.parts.size() > 2) context.bin = one.parts[2];
  auto opened = open_asset(directory_of(one), 0, context);
  if (!opened) return 0;
  AssetDecoder& decoder = **opened;
  const auto announced = decoder.announce();
  const MeshUpdate mesh = announced ? std::get<MeshUpdate>(*announced) : MeshUpdate();
  for (size_t i = 3; i < one.parts.size(); i++) {
    const uint64_t before = decoder.added();
    LW_ASSERT(decoder.accepts());
    const bool intact = decoder.append(one.parts[i]).has_value();
    LW_ASSERT(decoder.added() >= before);
    decoder.settle();
    take_all(decoder, mesh);
    if (!intact) break;
  }
  return 0;
}
