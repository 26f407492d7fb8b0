// SPDX-License-Identifier: Apache-2.0
#include "lightwell/asset/texture_asset.h"

namespace lightwell {

std::optional<Update> TextureAsset::take(size_t) {
  if (taken_ || !complete()) return std::nullopt;
  taken_ = true;
  const TextureParameters& image = parameters();
  return TextureUpdate{asset_, static_cast<uint8_t>(image.format), image.width, image.height, file()};
}

}  // namespace lightwell
