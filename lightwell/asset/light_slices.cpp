// SPDX-License-Identifier: Apache-2.0
//
// The light codec light_codec_slices: records of moments in the order of slices (light/stream.h).
#include "lightwell/asset/codecs.h"
#include "lightwell/asset/light_asset.h"
#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

class LightSlices final : public LightAsset {
 public:
  LightSlices(uint32_t asset, Fill fill, LightDecoder decoder)
      : LightAsset(asset, fill, {decoder.layout().shape, decoder.layout().normal_offset, decoder.layout().scale}),
        decoder_(std::move(decoder)) {}

  Result<void> append(Bytes payload) override { return decoder_.append(payload); }
  const GridShape& shape() const override { return decoder_.layout().shape; }
  float normal_offset() const override { return decoder_.layout().normal_offset; }
  LightGrid filled(Fill fill) const override {
    LightGrid grid = decoder_.grid();
    push_pull(grid, decoder_.known(), fill);
    return grid;
  }
  size_t received() const override { return decoder_.received(); }
  uint64_t total() const override { return shape().count(); }

 private:
  LightDecoder decoder_;
};

}  // namespace

Result<std::unique_ptr<AssetDecoder>> open_light_slices(const AssetSource& source) {
  // 250 bytes a node for the decoder and the atlas, and as much again while missing nodes are filled.
  constexpr uint64_t bytes_a_node = 500;
  LW_TRY(layout, LightLayout::read(source.entry.parameters));
  LW_CHECK(source.context.spend(layout.shape.count() * bytes_a_node));
  LW_TRY(decoder, LightDecoder::open(source.entry.parameters, source.entry.length));
  return std::make_unique<LightSlices>(source.asset, source.context.fill, std::move(decoder));
}

}  // namespace lightwell
