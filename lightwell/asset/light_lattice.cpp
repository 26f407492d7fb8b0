// SPDX-License-Identifier: Apache-2.0
//
// The light codec light_codec_lattice: whole numbers in the lattice order, then bricks (light/lattice_stream.h).
#include "lightwell/asset/codecs.h"
#include "lightwell/asset/light_asset.h"
#include "lightwell/light/lattice_stream.h"

namespace lightwell {
namespace {

class LightLattice final : public LightAsset {
 public:
  LightLattice(uint32_t asset, Fill fill, LatticeDecoder decoder)
      : LightAsset(
            asset, fill,
            {decoder.layout().shape, decoder.layout().normal_offset, decoder.layout().scale, decoder.layout().tree}),
        decoder_(std::move(decoder)) {}

  Result<void> append(Bytes payload) override { return decoder_.append(payload); }
  const GridShape& shape() const override { return decoder_.layout().shape; }
  float normal_offset() const override { return decoder_.layout().normal_offset; }
  std::span<const Brick> bricks() const override { return decoder_.layout().tree.bricks(); }
  LightGrid filled(Fill fill) const override { return decoder_.grid(fill); }
  size_t received() const override { return decoder_.received(); }
  uint64_t total() const override { return decoder_.total(); }

 private:
  LatticeDecoder decoder_;
};

}  // namespace

Result<std::unique_ptr<AssetDecoder>> open_light_lattice(const AssetSource& source) {
  // Values, order and moments of a node, and as much again while missing nodes are filled; of a brick its 125 points'.
  constexpr uint64_t bytes_a_node = 500, bytes_a_brick = 32'000, bytes_a_texel = 8;
  LW_TRY(layout, LatticeLayout::read(source.entry.parameters));
  LW_CHECK(source.context.spend(layout.shape.count() * bytes_a_node + layout.tree.bricks().size() * bytes_a_brick +
                                LightAtlas::texels(layout.shape, layout.tree) * bytes_a_texel));
  LW_TRY(decoder, LatticeDecoder::open(source.entry.parameters, source.entry.length));
  return std::make_unique<LightLattice>(source.asset, source.context.fill, std::move(decoder));
}

}  // namespace lightwell
