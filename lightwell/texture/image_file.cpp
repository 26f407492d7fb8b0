// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/image_file.h"

#include "lightwell/texture/ktx2_file.h"
#include "lightwell/texture/mip.h"

namespace lightwell {
namespace {

// Quality of previews: they are enlarged, so that blocks would show more than elsewhere.
constexpr int preview_quality = 85;

bool has_alpha(const Image& image) { return image.channels == 2 || image.channels == 4; }

bool is_opaque(const Image& image) {
  if (!has_alpha(image)) return true;
  const auto channels = static_cast<size_t>(image.channels);
  for (size_t i = channels - 1; i < image.pixels.size(); i += channels) {
    if (image.pixels[i] != 255) return false;
  }
  return true;
}

Image without_alpha(const Image& image) {
  Image opaque{image.width, image.height, image.channels - 1, {}};
  const auto channels = static_cast<size_t>(image.channels);
  for (size_t i = 0; i < image.pixels.size(); i++) {
    if (i % channels != channels - 1) opaque.pixels.push_back(image.pixels[i]);
  }
  return opaque;
}

}  // namespace

Result<void> check_image_size(uint64_t width, uint64_t height, ImageLimit limit) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width == 0 || height == 0) return fail(size, "an empty image");
  if (width > limit.side() || height > limit.side() || width * height > limit.pixels)
    return fail(ErrorKind::limit, size,
                "an image may have " + std::to_string(limit.side()) + " pixels a side, and " +
                    std::to_string(limit.pixels >> 20) + " million in all");
  return {};
}

Error naming_image_option(Error error) {
  if (error.kind == ErrorKind::limit) error.reason += "; --max-image-megapixels raises that";
  return error;
}

Result<Image> read_image_file(Bytes file, ImageLimit limit) {
  const auto format = image_format(file);
  if (!format) return is_ktx2(file) ? read_ktx2(file, limit) : read_bmp_or_tga(file, limit);
  switch (*format) {
    case ImageFormat::png: return read_png(file, limit);
    case ImageFormat::jpeg: return read_jpeg(file, limit);
    case ImageFormat::webp: return read_webp(file, limit);
  }
  return read_bmp_or_tga(file, limit);
}

std::vector<uint8_t> write_preview(const Image& image, int longest_side, bool color) {
  Image mip = smallest_mip(image, longest_side, color);
  if (!is_opaque(mip)) return write_png(mip);
  if (has_alpha(mip)) mip = without_alpha(mip);
  std::vector<uint8_t> png = write_png(mip);
  std::vector<uint8_t> jpeg = write_jpeg(mip, preview_quality);
  return jpeg.size() < png.size() ? jpeg : png;
}

}  // namespace lightwell
