// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "lightwell/scene/scene.h"

namespace lightwell {

// The pixels of a latitude-longitude map (see Environment): row by row from above, row edges of equal polar angle.

/// The cosine of the polar angle at the upper edge of a row.
inline float cos_edge(int row, int height) {
  return std::cos(std::numbers::pi_v<float> * static_cast<float>(row) / static_cast<float>(height));
}

/// The solid angle of a pixel in a row, sr.
inline float solid_angle(int row, const RadianceImage& map) {
  constexpr float half_turn = std::numbers::pi_v<float>;
  // The difference of the edges' cosines as a product, which does not vanish near the poles.
  const float half = half_turn / (2 * static_cast<float>(map.height));
  const float difference = 2 * std::sin(static_cast<float>(2 * row + 1) * half) * std::sin(half);
  return 2 * half_turn / static_cast<float>(map.width) * difference;
}

inline Vec3f pixel_radiance(const RadianceImage& map, size_t pixel) {
  const float* p = &map.pixels[3 * pixel];
  return max(Vec3f{{p[0], p[1], p[2]}}, Vec3f{});
}

/// The unit direction towards the middle of a pixel.
inline Vec3f pixel_direction(const RadianceImage& map, size_t pixel) {
  constexpr float half_turn = std::numbers::pi_v<float>;
  const auto width = static_cast<size_t>(map.width);
  const size_t row = pixel / width;
  const float polar = half_turn * (static_cast<float>(row) + 0.5f) / static_cast<float>(map.height);
  const float angle =
      2 * half_turn * ((static_cast<float>(pixel % width) + 0.5f) / static_cast<float>(map.width) - 0.5f);
  return {{std::sin(polar) * std::sin(angle), std::cos(polar), -std::sin(polar) * std::cos(angle)}};
}

}  // namespace lightwell
