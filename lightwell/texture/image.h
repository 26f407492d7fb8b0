// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace lightwell {

/// A picture of 8-bit channels, as stored in its file (no transfer function applied), first row at the top.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;             ///< 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA
  std::vector<uint8_t> pixels;  ///< width * height * channels
};

/// A picture of linear RGB radiance, first row at the top.
struct RadianceImage {
  int width = 0;
  int height = 0;
  std::vector<float> pixels;  ///< width * height * 3
};

/// The largest picture that is accepted; checked before memory is allocated.
struct ImageLimit {
  uint64_t pixels = uint64_t(1) << 26;

  /// Pixels of its longest side: of a picture four times as long as wide.
  uint64_t side() const { return 2 * static_cast<uint64_t>(std::sqrt(static_cast<double>(pixels))); }
};

/// The highest limit that may be set: products of sizes stay within 32 bits.
constexpr ImageLimit highest_image_limit = {uint64_t(1) << 29};

}  // namespace lightwell
