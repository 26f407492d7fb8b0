// SPDX-License-Identifier: Apache-2.0
//
// The mesh codecs mesh_codec_splits and mesh_codec_regions: vertex splits that refine the coarsest level in the opening
// (mesh/stream.h).
#include "lightwell/asset/codecs.h"
#include "lightwell/asset/mesh_asset.h"

namespace lightwell {
namespace {

class MeshSplits final : public MeshAsset {
 public:
  MeshSplits(uint32_t asset, const BasePlaces& places, MeshDecoder decoder)
      : MeshAsset(asset, decoder.layout(), places), decoder_(std::move(decoder)) {}

  MeshBuffers buffers() const override {
    return {decoder_.vertices(),
            decoder_.faces(),
            decoder_.positions(),
            decoder_.normals(),
            {decoder_.texcoords(0), decoder_.texcoords(1)},
            decoder_.colors(),
            decoder_.complete()};
  }
  const MeshLayout& layout() const override { return decoder_.layout(); }
  std::span<const uint32_t> indices(size_t region) const override { return decoder_.indices(region); }
  std::span<const uint32_t> index_buffer() const override { return decoder_.index_buffer(); }

 protected:
  Result<void> decode(Bytes payload) override { return decoder_.append(payload); }
  MeshChanges take_changes() override { return decoder_.take_changes(); }

 private:
  MeshDecoder decoder_;
};

}  // namespace

Result<std::unique_ptr<AssetDecoder>> open_mesh_splits(const AssetSource& source) {
  const bool has_regions = source.entry.codec == mesh_codec_regions;
  LW_TRY(parameters, MeshParameters::read(source.entry.parameters, has_regions));
  LW_CHECK(source.context.spend(parameters.layout.buffer_bytes()));
  LW_TRY(base, BaseArrays::read(parameters.layout, parameters.places, source.context.bin));
  LW_TRY(decoder, MeshDecoder::open(std::move(parameters.layout), base.view(), source.entry.length));
  return std::make_unique<MeshSplits>(source.asset, parameters.places, std::move(decoder));
}

}  // namespace lightwell
