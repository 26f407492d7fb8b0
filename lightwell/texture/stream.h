// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/texture/image_format.h"

namespace lightwell {

/// The codec number of this header's format: an image file as it is, in blocks (base/file_blocks.h).
inline constexpr uint8_t texture_codec_file = 0;

/// The parameters of a texture stream (docs/format.md): what file its blocks make up.
struct TextureParameters {
  uint32_t bytes = 0;  ///< of the whole file
  ImageFormat format = ImageFormat::png;
  uint32_t width = 0;  ///< pixels
  uint32_t height = 0;

  bool operator==(const TextureParameters&) const = default;
};

std::vector<uint8_t> encode_texture_parameters(const TextureParameters& parameters);

/// Fails for an unknown format, an empty file or image, and wrong lengths.
Result<TextureParameters> decode_texture_parameters(Bytes bytes);

}  // namespace lightwell
