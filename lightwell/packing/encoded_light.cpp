// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/encoded_light.h"

#include <algorithm>

#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

template <typename Layout>
PackStream stream_of(StreamKind kind, uint8_t codec, const Layout& layout, std::vector<LightBundle> bundles,
                     float error) {
  PackStream stream{.kind = kind, .codec = codec, .error = error, .parameters = {}, .blocks = {}};
  ByteWriter parameters;
  layout.write(parameters);
  stream.parameters = parameters.release();
  for (LightBundle& bundle : bundles) stream.blocks.push_back({std::move(bundle.payload), bundle.nodes, bundle.error});
  return stream;
}

/// The error of the eight corners alone is unknown; it may be as large as the light itself.
float error_of_corners(const std::vector<LightBundle>& bundles) {
  return bundles.empty() ? 0 : std::max(1.0f, bundles.front().error);
}

/// Of one grid the streams of its bricks.
std::vector<PackStream> brick_streams(LatticeStream& encoded, uint32_t grid) {
  std::vector<PackStream> streams;
  const float before = encoded.bundles.empty() ? 1 : encoded.bundles.back().error;
  for (uint32_t region = 0; region < encoded.regions.size(); region++)
    streams.push_back(stream_of(StreamKind::bricks, bricks_codec_lattice, BricksLayout{grid, region},
                                std::move(encoded.regions[region]), before));
  return streams;
}

}  // namespace

Result<EncodedLight> encode_light(std::span<const PackGrid> grids) {
  EncodedLight light;
  light.bricks.resize(grids.size());
  std::vector<PackStream> bricks;
  for (uint32_t i = 0; i < grids.size(); i++) {
    const PackGrid& grid = grids[i];
    if (grid.order == LightNodeOrder::slices) {
      LW_TRY(encoded, encode_light(*grid.grid, {.seed = grid.seed}));
      const float error = error_of_corners(encoded.bundles);
      light.streams.push_back(
          stream_of(StreamKind::light, light_codec_slices, encoded.layout, std::move(encoded.bundles), error));
      continue;
    }
    LW_TRY(encoded, encode_lattice(*grid.grid, {.record = grid.record}));
    for (const BrickRegion& region : encoded.layout.regions)
      if (encoded.layout.apart())
        light.bricks[i].push_back(describe_bricks(
            grid.grid->shape, region, static_cast<uint32_t>(grids.size() + bricks.size() + light.bricks[i].size())));
    for (PackStream& stream : brick_streams(encoded, i)) bricks.push_back(std::move(stream));
    const float error = error_of_corners(encoded.bundles);
    light.streams.push_back(
        stream_of(StreamKind::light, light_codec_lattice, encoded.layout, std::move(encoded.bundles), error));
  }
  std::ranges::move(bricks, std::back_inserter(light.streams));
  return light;
}

}  // namespace lightwell
