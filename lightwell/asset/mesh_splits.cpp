// SPDX-License-Identifier: Apache-2.0
//
// The mesh codec mesh_codec_splits: vertex splits that refine the coarsest level in the opening (mesh/stream.h).
#include "lightwell/asset/codecs.h"
#include "lightwell/asset/mesh_asset.h"

namespace lightwell {
namespace {

class MeshSplits final : public MeshAsset {
 public:
  MeshSplits(uint32_t asset, const MeshParameters& parameters, MeshDecoder decoder)
      : MeshAsset(asset, parameters), decoder_(std::move(decoder)) {}

  MeshBuffers buffers() const override {
    return {decoder_.vertices(),
            decoder_.faces(),
            decoder_.positions(),
            decoder_.normals(),
            {decoder_.texcoords(0), decoder_.texcoords(1)},
            decoder_.colors(),
            decoder_.indices(),
            decoder_.complete()};
  }

 protected:
  Result<void> decode(Bytes payload) override { return decoder_.append(payload); }
  MeshChanges take_changes() override { return decoder_.take_changes(); }

 private:
  MeshDecoder decoder_;
};

}  // namespace

Result<std::unique_ptr<AssetDecoder>> open_mesh_splits(const AssetSource& source) {
  LW_TRY(parameters, MeshParameters::read(source.entry.parameters));
  LW_CHECK(source.context.spend(parameters.layout.buffer_bytes()));
  LW_TRY(base, BaseArrays::read(parameters.layout, parameters.places, source.context.bin));
  LW_TRY(decoder, MeshDecoder::open(parameters.layout, base.view(), source.entry.length));
  return std::make_unique<MeshSplits>(source.asset, parameters, std::move(decoder));
}

}  // namespace lightwell
