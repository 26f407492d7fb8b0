// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lightwell/asset/asset.h"
#include "lightwell/light/atlas.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/pack/directory.h"

namespace lightwell {

/// A light grid of any codec, whose missing nodes are filled for each update. Derived classes decode the blocks.
class LightAsset : public AssetDecoder {
 public:
  static constexpr StreamKind kind = StreamKind::light;

  virtual const GridShape& shape() const = 0;
  virtual float normal_offset() const = 0;
  virtual std::span<const Brick> bricks() const { return {}; }
  /// The grid as far as it has come, irradiance in W/m2, its missing nodes filled.
  virtual LightGrid filled(Fill fill) const = 0;
  /// Number of known nodes.
  virtual size_t received() const = 0;

  uint64_t added() const final { return received(); }
  bool complete() const override { return received() == total(); }
  /// False once an eighth more nodes are known than at the last settle(), or all are. This spreads the cost of filling
  /// over the stream, however small its blocks are.
  bool settled() const final;
  /// Fills the missing nodes and writes the atlas.
  bool settle() final;
  std::optional<Update> take(size_t budget) final;
  uint64_t decoded() const final { return received(); }

 protected:
  LightAsset(uint32_t asset, Fill fill, LightAtlas atlas) : asset_(asset), fill_(fill), atlas_(std::move(atlas)) {}

 private:
  uint32_t asset_;
  Fill fill_;
  LightAtlas atlas_;
  size_t settled_ = 0;  ///< known nodes in the atlas
  size_t taken_ = 0;    ///< known nodes in the atlas last taken
};

}  // namespace lightwell
