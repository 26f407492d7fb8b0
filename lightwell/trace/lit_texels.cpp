// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lit_texels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightwell {
namespace {

constexpr int most_cells = 512;

bool lit(const Image& image, size_t texel) {
  const size_t colors = image.channels < 3 ? 1 : 3;
  const uint8_t* codes = &image.pixels[texel * static_cast<size_t>(image.channels)];
  return std::any_of(codes, codes + colors, [](uint8_t code) { return code > 0; });
}

}  // namespace

LitTexels::LitTexels(const Image& image)
    : width_(image.width),
      height_(image.height),
      cell_((std::max(image.width, image.height) + most_cells - 1) / most_cells),
      columns_(static_cast<size_t>((image.width + cell_ - 1) / cell_) + 1) {
  const size_t side = static_cast<size_t>(cell_), width = static_cast<size_t>(width_);
  const size_t rows = (static_cast<size_t>(height_) + side - 1) / side + 1;
  below_.assign(columns_ * rows, 0);
  for (size_t texel = 0; texel < width * static_cast<size_t>(height_); texel++)
    if (lit(image, texel)) below_[(texel / width / side + 1) * columns_ + texel % width / side + 1] = 1;
  for (size_t row = 1; row < rows; row++) {
    uint32_t in_row = 0;
    for (size_t column = 1; column < columns_; column++) {
      uint32_t& sum = below_[row * columns_ + column];
      in_row += sum;
      sum = in_row + below_[(row - 1) * columns_ + column];
    }
  }
}

/// The texels that coordinates between lo and hi read; the whole axis where they wrap around its end.
LitTexels::Span LitTexels::span(float lo, float hi, int size, TextureLookup::Wrap wrap) {
  const Span whole{0, size - 1};
  if (!(hi - lo < static_cast<float>(size)) || !(std::abs(lo) < 1e6f)) return whole;
  // Bilinear lookups read both neighbours.
  const int first = static_cast<int>(std::floor(lo)), last = static_cast<int>(std::floor(hi)) + 1;
  if (wrap == TextureLookup::Wrap::clamp) return {std::clamp(first, 0, size - 1), std::clamp(last, 0, size - 1)};
  const int period = static_cast<int>(std::floor(static_cast<float>(first) / static_cast<float>(size)));
  const Span within{first - period * size, last - period * size};
  if (within.last >= size) return whole;
  const bool mirrored = wrap == TextureLookup::Wrap::mirror && period % 2 != 0;
  return mirrored ? Span{size - 1 - within.last, size - 1 - within.first} : within;
}

bool LitTexels::any(const TextureLookup& texture, const std::array<Vec2f, 3>& texcoords) const {
  Vec2f lo = Vec2f::filled(std::numeric_limits<float>::infinity()), hi = -lo;
  for (const Vec2f& t : texcoords) {
    const Vec3f homogeneous{{t[0], t[1], 1}};
    const Vec2f texel{{dot(Vec3f{texture.row_u}, homogeneous) * static_cast<float>(width_) - 0.5f,
                       dot(Vec3f{texture.row_v}, homogeneous) * static_cast<float>(height_) - 0.5f}};
    lo = min(lo, texel);
    hi = max(hi, texel);
  }
  const Span x = span(lo[0], hi[0], width_, texture.wrap_u), y = span(lo[1], hi[1], height_, texture.wrap_v);
  const auto at = [&](int column, int row) {
    return below_[static_cast<size_t>(row) * columns_ + static_cast<size_t>(column)];
  };
  const int left = x.first / cell_, right = x.last / cell_ + 1, top = y.first / cell_, bottom = y.last / cell_ + 1;
  return at(right, bottom) + at(left, top) != at(right, top) + at(left, bottom);
}

}  // namespace lightwell
