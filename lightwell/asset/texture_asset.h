// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/asset/file_asset.h"
#include "lightwell/texture/stream.h"

namespace lightwell {

/// An image file.
class TextureAsset final : public FileAsset {
 public:
  static constexpr StreamKind kind = StreamKind::texture;

  TextureAsset(uint32_t asset, const TextureParameters& parameters)
      : FileAsset(parameters.bytes), asset_(asset), parameters_(parameters) {}

 private:
  Result<void> check() const override;
  Update update() const override;

  uint32_t asset_;
  TextureParameters parameters_;
};

}  // namespace lightwell
