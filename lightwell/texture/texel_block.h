// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "lightwell/texture/image.h"

namespace lightwell {

/// Texels on a side of the blocks of ETC1S and UASTC.
constexpr size_t texel_block_side = 4;

/// How many blocks cover so many pixels of a row or column.
constexpr size_t texel_blocks(size_t pixels) { return (pixels + texel_block_side - 1) / texel_block_side; }

/// Calls put(pixel, texel) for each texel of a block, 0 to 15 row by row from the top, with the first channel of its
/// pixel. Texels beyond the image's right and lower edge are left out.
template <typename Put>
void put_texel_block(Image& image, size_t block_x, size_t block_y, const Put& put) {
  const auto width = static_cast<size_t>(image.width), height = static_cast<size_t>(image.height);
  const size_t left = block_x * texel_block_side, top = block_y * texel_block_side;
  const size_t right = std::min(left + texel_block_side, width), bottom = std::min(top + texel_block_side, height);
  for (size_t y = top; y < bottom; y++) {
    uint8_t* pixel = &image.pixels[(y * width + left) * static_cast<size_t>(image.channels)];
    for (size_t x = left; x < right; x++, pixel += image.channels) put(pixel, (y - top) * texel_block_side + x - left);
  }
}

}  // namespace lightwell
