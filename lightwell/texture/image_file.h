// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/texture/image.h"
#include "lightwell/texture/image_format.h"

namespace lightwell {

/// Fails when an image of this size is empty or beyond the limit.
Result<void> check_image_size(uint64_t width, uint64_t height, ImageLimit limit = {});

/// The error with the option that raises the limit, where it is one of a picture beyond that.
Error naming_image_option(Error error);

/// Decodes a PNG, JPEG, WebP, KTX2, BMP or TGA file, recognised by content. Sixteen bits become eight, palettes and bit
/// depths below eight are expanded, CMYK becomes RGB; channels stay as they are otherwise. Colour profiles and gamma
/// chunks are ignored, as glTF asks (section 3.8.3). Errors name the format and the reason; any bytes are safe.
Result<Image> read_image_file(Bytes file, ImageLimit limit = {});

/// The readers of single formats, among which read_image_file chooses; that of KTX2 is in ktx2_file.h.
Result<Image> read_png(Bytes file, ImageLimit limit = {});
Result<Image> read_jpeg(Bytes file, ImageLimit limit = {});
Result<Image> read_webp(Bytes file, ImageLimit limit = {});
/// BMP without compression, TGA with run lengths or without; neither can be in a pack (image_format.h).
Result<Image> read_bmp_or_tga(Bytes file, ImageLimit limit = {});

/// A PNG file of an image of one to four channels.
std::vector<uint8_t> write_png(const Image& image);

/// A JPEG file of an image of one or three channels; quality as in libjpeg, 1 to 100.
std::vector<uint8_t> write_jpeg(const Image& image, int quality);

/// A WebP file, with loss, of an image of one to four channels; quality as in libwebp, 0 to 100. Empty when it is too
/// large for one: more than 16,383 pixels a side.
std::vector<uint8_t> write_webp(const Image& image, int quality);

/// The small picture that stands for a texture in a pack's opening: the mip of at most `longest_side` pixels a side, as
/// PNG or, where that is smaller and nothing is transparent, JPEG. `color`: see smallest_mip.
std::vector<uint8_t> write_preview(const Image& image, int longest_side, bool color);

}  // namespace lightwell
