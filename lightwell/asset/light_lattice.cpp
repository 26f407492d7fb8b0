// SPDX-License-Identifier: Apache-2.0
//
// The light codec light_codec_lattice: whole numbers in the lattice order, then bricks (light/lattice_stream.h), unless
// those are apart (light_bricks.cpp).
#include <algorithm>

#include "lightwell/asset/codecs.h"
#include "lightwell/asset/light_asset.h"
#include "lightwell/light/lattice_stream.h"

namespace lightwell {
namespace {

class LightLattice final : public LightAsset {
 public:
  LightLattice(uint32_t asset, Fill fill, std::shared_ptr<LatticeDecoder> decoder)
      : LightAsset(asset, fill,
                   {decoder->layout().shape, decoder->layout().normal_offset, decoder->layout().scale,
                    decoder->layout().tree}),
        decoder_(std::move(decoder)) {}

  Result<void> append(Bytes payload) override { return decoder_->append(payload); }
  bool complete() const override { return decoder_->complete(); }
  const GridShape& shape() const override { return decoder_->layout().shape; }
  float normal_offset() const override { return decoder_->layout().normal_offset; }
  std::span<const Brick> bricks() const override { return decoder_->layout().tree.bricks(); }
  LightGrid filled(Fill fill) const override { return decoder_->grid(fill); }
  size_t received() const override { return decoder_->received(); }
  uint64_t total() const override { return decoder_->total(); }

 private:
  std::shared_ptr<LatticeDecoder> decoder_;
};

/// The streams of bricks of a grid; and that each of its regions has one.
Result<uint64_t> bytes_of_bricks(const AssetSource& source, const LatticeLayout& layout) {
  uint64_t bytes = 0;
  std::vector<uint8_t> there(layout.apart() ? layout.regions.size() : 0);
  const std::vector<StreamEntry>& streams = source.directory.streams;
  for (size_t stream = source.asset; stream < streams.size(); stream++) {
    if (streams[stream].kind != StreamKind::bricks) continue;
    const auto bricks = BricksLayout::read(streams[stream].parameters);
    if (!bricks || bricks->grid != source.asset) continue;
    if (bricks->region >= there.size() || there[bricks->region]++ > 0)
      return fail("light parameters", "do not go with its streams of bricks");
    bytes += streams[stream].length;
  }
  if (std::ranges::count(there, 0) > 0) return fail("light parameters", "promise bricks that there are not");
  return bytes;
}

}  // namespace

Result<std::unique_ptr<AssetDecoder>> open_light_lattice(const AssetSource& source) {
  // Values, order and moments of a node, and as much again while missing nodes are filled; of a brick its 125 points'.
  constexpr uint64_t bytes_a_node = 500, bytes_a_brick = 32'000, bytes_a_texel = 8;
  LW_TRY(layout, LatticeLayout::read(source.entry.parameters));
  LW_CHECK(source.context.spend(layout.shape.count() * bytes_a_node + layout.tree.bricks().size() * bytes_a_brick +
                                LightAtlas::texels(layout.shape, layout.tree) * bytes_a_texel));
  LW_TRY(bytes, bytes_of_bricks(source, layout));
  LW_TRY(opened, LatticeDecoder::open(source.entry.parameters, source.entry.length + bytes));
  const auto decoder = std::make_shared<LatticeDecoder>(std::move(opened));
  source.context.lattices.resize(source.directory.streams.size());
  source.context.lattices[source.asset] = decoder;
  return std::make_unique<LightLattice>(source.asset, source.context.fill, decoder);
}

}  // namespace lightwell
