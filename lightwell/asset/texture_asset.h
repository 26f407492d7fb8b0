// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/asset/asset.h"
#include "lightwell/pack/directory.h"
#include "lightwell/texture/stream.h"

namespace lightwell {

/// An image of any codec: returns its file once it is complete. Derived classes decode the blocks.
class TextureAsset : public AssetDecoder {
 public:
  static constexpr StreamKind kind = StreamKind::texture;

  virtual const TextureParameters& parameters() const = 0;
  /// The bytes decoded so far; when complete, the image file.
  virtual const std::vector<uint8_t>& file() const = 0;

  uint64_t added() const final { return file().size(); }
  bool complete() const final { return file().size() == parameters().bytes; }
  std::optional<Update> take(size_t budget) final;

 protected:
  explicit TextureAsset(uint32_t asset) : asset_(asset) {}

 private:
  uint32_t asset_;
  bool taken_ = false;
};

}  // namespace lightwell
