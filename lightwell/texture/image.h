// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace lightwell
