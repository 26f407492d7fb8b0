// SPDX-License-Identifier: Apache-2.0
//
// Decodes a stream of any kind, codec and bytes, and bricks that go with it, given as a case
// (tests/asset/asset_case.h), with a small memory budget: the ranges that it delivers lie inside the buffers that it
// has announced.
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
  const Directory directory = directory_of(one);
  std::vector<std::unique_ptr<AssetDecoder>> decoders;
  for (uint32_t stream = 0; stream < directory.streams.size(); stream++) {
    auto opened = open_asset(directory, stream, context);
    if (!opened) return 0;
    decoders.push_back(std::move(*opened));
  }
  AssetDecoder& first = *decoders.front();
  const auto announced = first.announce();
  const MeshUpdate mesh = announced ? std::get<MeshUpdate>(*announced) : MeshUpdate();
  LW_ASSERT(first.accepts());
  size_t turn = 0;
  for (size_t i = 3; i < one.parts.size(); i++) {
    if (first.complete()) turn = (turn + 1) % decoders.size();
    AssetDecoder& decoder = *decoders[turn];
    const uint64_t before = decoder.added();
    const bool intact = decoder.append(one.parts[i]).has_value();
    LW_ASSERT(decoder.added() >= before);
    first.settle();
    take_all(first, mesh);
    if (!intact) break;
  }
  return 0;
}
