// SPDX-License-Identifier: Apache-2.0
#include <webp/decode.h>
#include <webp/encode.h>

#include <algorithm>

#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

// One colour takes no bits a pixel in a lossless file, so that its header may claim any size. What needs more memory
// than this many pixels must have bytes to show for it, as every PNG has.
constexpr uint64_t free_pixels = uint64_t(1) << 24;
constexpr uint64_t pixels_per_byte = 1024;

}  // namespace

Result<Image> read_webp(Bytes file, ImageLimit limit) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(file.data(), file.size(), &features) != VP8_STATUS_OK) return fail("WebP", "damaged header");
  if (features.has_animation) return fail(ErrorKind::unsupported, "WebP", "is an animation");
  LW_CHECK(check_image_size(static_cast<uint64_t>(features.width), static_cast<uint64_t>(features.height), limit));
  const uint64_t pixels = static_cast<uint64_t>(features.width) * static_cast<uint64_t>(features.height);
  if (pixels > free_pixels + file.size() * pixels_per_byte)
    return fail("WebP", "claims more pixels than it has bytes for");
  Image image{features.width, features.height, features.has_alpha ? 4 : 3, {}};
  const size_t stride = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels);
  image.pixels.resize(stride * static_cast<size_t>(image.height));
  const auto decode = features.has_alpha ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  if (!decode(file.data(), file.size(), image.pixels.data(), image.pixels.size(), static_cast<int>(stride)))
    return fail("WebP", "the file is damaged or ends too early");
  return image;
}

std::vector<uint8_t> write_webp(const Image& image, int quality) {
  // WebP has colours, with alpha or without.
  const auto channels = static_cast<size_t>(image.channels), colors = channels < 3 ? size_t(1) : size_t(3);
  const size_t pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  const bool has_alpha = channels % 2 == 0;
  const size_t written = has_alpha ? 4 : 3;
  std::vector<uint8_t> rgb(pixels * written);
  for (size_t i = 0; i < pixels; i++) {
    for (size_t c = 0; c < 3; c++) rgb[i * written + c] = image.pixels[i * channels + std::min(c, colors - 1)];
    if (has_alpha) rgb[i * written + 3] = image.pixels[i * channels + colors];
  }
  uint8_t* bytes = nullptr;
  const auto encode = has_alpha ? WebPEncodeRGBA : WebPEncodeRGB;
  const size_t size = encode(rgb.data(), image.width, image.height, image.width * static_cast<int>(written),
                             static_cast<float>(quality), &bytes);
  std::vector<uint8_t> file(bytes, bytes + size);
  WebPFree(bytes);
  return file;
}

}  // namespace lightwell
