// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/cutout.h"

#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

bool has_alpha(const Image& image) { return image.channels % 2 == 0; }

/// A channel of the pixel at a place of a picture of another size.
uint8_t sample(const Image& image, int x, int y, const Image& in_size_of, int channel) {
  const auto scaled = [](int at, int from, int to) { return (int64_t(2) * at + 1) * to / (int64_t(2) * from); };
  const auto column = static_cast<size_t>(scaled(x, in_size_of.width, image.width));
  const auto row = static_cast<size_t>(scaled(y, in_size_of.height, image.height));
  const size_t pixel = row * static_cast<size_t>(image.width) + column;
  return image.pixels[pixel * static_cast<size_t>(image.channels) + static_cast<size_t>(channel)];
}

}  // namespace

Result<std::vector<uint8_t>> cut_out(Bytes color, Bytes mask, ImageLimit limit) {
  LW_TRY(opacity, read_image_file(mask, limit));
  Image colors{1, 1, 1, {255}};
  if (!color.empty()) {
    LW_TRY(read, read_image_file(color, limit));
    colors = std::move(read);
  }
  const Image& size = color.empty() ? opacity : colors;
  Image cut{size.width, size.height, 4, {}};
  cut.pixels.reserve(static_cast<size_t>(size.width) * static_cast<size_t>(size.height) * 4);
  const bool grey = colors.channels < 3;
  for (int y = 0; y < cut.height; y++)
    for (int x = 0; x < cut.width; x++) {
      for (int c = 0; c < 3; c++) cut.pixels.push_back(sample(colors, x, y, cut, grey ? 0 : c));
      cut.pixels.push_back(sample(opacity, x, y, cut, has_alpha(opacity) ? opacity.channels - 1 : 0));
    }
  return write_png(cut);
}

}  // namespace lightwell
