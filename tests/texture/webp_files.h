// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <webp/encode.h>

#include <vector>

#include "lightwell/texture/image.h"

namespace lightwell {

/// A WebP file without loss of an image of three or four channels.
inline std::vector<uint8_t> lossless_webp(const Image& image) {
  uint8_t* bytes = nullptr;
  const auto encode = image.channels == 4 ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB;
  const size_t size = encode(image.pixels.data(), image.width, image.height, image.width * image.channels, &bytes);
  std::vector<uint8_t> file(bytes, bytes + size);
  WebPFree(bytes);
  return file;
}

}  // namespace lightwell
