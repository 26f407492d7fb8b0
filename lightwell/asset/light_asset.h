// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lightwell/asset/asset.h"
#include "lightwell/light/atlas.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/pack/directory.h"

namespace lightwell {

/// A light grid, by whichever codec: hands it over with its holes filled. A codec derives from it and says how a block
/// is decoded.
class LightAsset : public AssetDecoder {
 public:
  static constexpr StreamKind kind = StreamKind::light;

  /// The known nodes, irradiance in W/m2; the others are dark.
  virtual const LightGrid& grid() const = 0;
  /// A byte a node: 1 where grid() holds the node.
  virtual std::span<const uint8_t> known() const = 0;
  /// Number of nodes known.
  virtual size_t received() const = 0;

  uint64_t added() const final { return received(); }
  bool complete() const final { return received() == total(); }
  /// True unless an eighth more nodes are there than the last time, or all: so the cost of filling is spread over the
  /// stream, however small its blocks are.
  bool settled() const final;
  /// Fills the holes and writes the atlas.
  bool settle() final;
  std::optional<Update> take(size_t budget) final;
  uint64_t decoded() const final { return received(); }
  uint64_t total() const final { return grid().shape.count(); }

 protected:
  LightAsset(uint32_t asset, Fill fill, LightAtlas atlas) : asset_(asset), fill_(fill), atlas_(std::move(atlas)) {}

 private:
  uint32_t asset_;
  Fill fill_;
  LightAtlas atlas_;
  size_t settled_ = 0;  ///< nodes in the atlas
  size_t taken_ = 0;    ///< nodes in the atlas that was handed over
};

}  // namespace lightwell
