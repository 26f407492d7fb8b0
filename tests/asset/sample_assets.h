// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/asset/codecs.h"
#include "lightwell/pack/opening.h"
#include "tests/client/sample_pack.h"
#include "tests/pack/pack_samples.h"

namespace lightwell {

/// A small pack of every kind, opened.
struct SampleAssets {
  SampleScene scene = sample_scene(500, 8);
  std::vector<uint8_t> file = sample_pack(scene);
  PackReader reader = PackReader::open(from_memory(file), file.size()).value();

  uint32_t streams() const { return static_cast<uint32_t>(reader.directory().streams.size()); }
  const StreamEntry& entry(uint32_t stream) const { return reader.directory().streams[stream]; }
  Bytes bin() const { return glb_chunks(reader.opening()).bin; }
  AssetContext context() const { return {.bin = bin(), .fill = Fill::none}; }
  std::vector<std::vector<uint8_t>> payloads(uint32_t stream) const {
    std::vector<std::vector<uint8_t>> all;
    for (uint32_t i = 0; i < entry(stream).blocks; i++) all.push_back(reader.block(stream, i).value());
    return all;
  }
};

}  // namespace lightwell
