// SPDX-License-Identifier: Apache-2.0
#include <webp/decode.h>

#include "lightwell/texture/image_file.h"

namespace lightwell {

Result<Image> read_webp(Bytes file) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(file.data(), file.size(), &features) != VP8_STATUS_OK) return fail("WebP", "damaged header");
  if (features.has_animation) return fail("WebP", "is an animation");
  LW_CHECK(check_image_size(static_cast<uint64_t>(features.width), static_cast<uint64_t>(features.height)));
  Image image{features.width, features.height, features.has_alpha ? 4 : 3, {}};
  const size_t stride = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels);
  image.pixels.resize(stride * static_cast<size_t>(image.height));
  const auto decode = features.has_alpha ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  if (!decode(file.data(), file.size(), image.pixels.data(), image.pixels.size(), static_cast<int>(stride)))
    return fail("WebP", "the file is damaged or ends too early");
  return image;
}

}  // namespace lightwell
