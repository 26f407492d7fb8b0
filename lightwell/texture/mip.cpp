// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/mip.h"

#include <array>

#include "lightwell/base/assert.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

struct Rectangle {
  size_t x0, x1, y0, y1;
};

// A weight for transparent pixels: where nothing is opaque the mean is that of all colours.
constexpr float least_weight = 1.0f / 65536;

/// Averages the pixels of a rectangle into `out`, one byte a channel.
void average(const Image& image, const Rectangle& area, bool color, uint8_t* out) {
  const auto channels = static_cast<size_t>(image.channels);
  const bool has_alpha = channels % 2 == 0;
  const size_t colors = has_alpha ? channels - 1 : channels;
  std::array<double, 3> sum{};
  double weights = 0, alphas = 0;
  for (size_t y = area.y0; y < area.y1; y++) {
    for (size_t x = area.x0; x < area.x1; x++) {
      const uint8_t* pixel = &image.pixels[(y * static_cast<size_t>(image.width) + x) * channels];
      const float alpha = has_alpha ? static_cast<float>(pixel[colors]) / 255 : 1;
      const float weight = std::max(alpha, least_weight);
      for (size_t c = 0; c < colors; c++)
        sum[c] += weight * (color ? srgb_to_linear(pixel[c]) : static_cast<float>(pixel[c]) / 255);
      weights += weight;
      alphas += alpha;
    }
  }
  for (size_t c = 0; c < colors; c++) {
    const auto mean = static_cast<float>(sum[c] / weights);
    out[c] = to_byte(color ? linear_to_srgb(mean) : mean);
  }
  if (has_alpha)
    out[colors] = to_byte(static_cast<float>(alphas / static_cast<double>((area.x1 - area.x0) * (area.y1 - area.y0))));
}

}  // namespace

Image smallest_mip(const Image& image, int longest_side, bool color) {
  LW_ASSERT(longest_side > 0);
  const int longest = std::max(image.width, image.height);
  if (longest <= longest_side) return image;
  const auto reduced = [&](int side) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(side) * longest_side / longest)));
  };
  Image mip{reduced(image.width), reduced(image.height), image.channels, {}};
  const auto width = static_cast<size_t>(mip.width), height = static_cast<size_t>(mip.height);
  mip.pixels.resize(width * height * static_cast<size_t>(mip.channels));
  for (size_t y = 0; y < height; y++) {
    for (size_t x = 0; x < width; x++) {
      const auto from_width = static_cast<size_t>(image.width), from_height = static_cast<size_t>(image.height);
      const Rectangle area{x * from_width / width, (x + 1) * from_width / width, y * from_height / height,
                           (y + 1) * from_height / height};
      average(image, area, color, &mip.pixels[(y * width + x) * static_cast<size_t>(mip.channels)]);
    }
  }
  return mip;
}

}  // namespace lightwell
