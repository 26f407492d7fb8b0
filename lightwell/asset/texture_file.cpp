// SPDX-License-Identifier: Apache-2.0
//
// The texture codec texture_codec_file: an image file cut into blocks (texture/stream.h).
#include "lightwell/asset/texture_asset.h"
#include "lightwell/texture/image_size.h"

namespace lightwell {

/// A page has made room for an image of the size that was promised.
Result<void> TextureAsset::check() const {
  const auto size = image_size(file());
  if (image_format(file()) == parameters_.format && size == ImageSize{parameters_.width, parameters_.height}) return {};
  return fail("image", "is not of the size and format that its stream states");
}

Update TextureAsset::update() const {
  return TextureUpdate{asset_, static_cast<uint8_t>(parameters_.format), parameters_.width, parameters_.height, file()};
}

Result<std::unique_ptr<AssetDecoder>> open_texture_file(const AssetSource& source) {
  LW_TRY(parameters, decode_texture_parameters(source.entry.parameters));
  LW_CHECK(spend_on_file(source, parameters.bytes));
  return std::make_unique<TextureAsset>(source.asset, parameters);
}

}  // namespace lightwell
