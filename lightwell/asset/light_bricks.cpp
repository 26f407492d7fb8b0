// SPDX-License-Identifier: Apache-2.0
//
// The bricks codec bricks_codec_lattice: bricks of a region of a grid of light_codec_lattice (light/lattice_stream.h).
#include "lightwell/asset/codecs.h"
#include "lightwell/light/lattice_stream.h"

namespace lightwell {
namespace {

/// Its updates are the grid's.
class LightBricks final : public AssetDecoder {
 public:
  LightBricks(std::shared_ptr<LatticeDecoder> grid, size_t region) : grid_(std::move(grid)), region_(region) {}

  bool accepts() const override { return grid_->complete(); }
  Result<void> append(Bytes payload) override { return grid_->append_bricks(region_, payload); }
  uint64_t added() const override { return grid_->received(region_); }
  bool complete() const override { return grid_->complete(region_); }
  std::optional<Update> take(size_t) override { return std::nullopt; }

 private:
  std::shared_ptr<LatticeDecoder> grid_;
  size_t region_;
};

}  // namespace

Result<std::unique_ptr<AssetDecoder>> open_light_bricks(const AssetSource& source) {
  LW_TRY(layout, BricksLayout::read(source.entry.parameters));
  const auto& lattices = source.context.lattices;
  const std::shared_ptr<LatticeDecoder> grid = layout.grid < lattices.size() ? lattices[layout.grid] : nullptr;
  if (!grid) return fail("bricks parameters", "name no grid before them");
  const LatticeLayout& of_grid = grid->layout();
  if (!of_grid.apart() || layout.region >= of_grid.regions.size())
    return fail("bricks parameters", "name a region that the grid does not have");
  return std::make_unique<LightBricks>(grid, layout.region);
}

}  // namespace lightwell
