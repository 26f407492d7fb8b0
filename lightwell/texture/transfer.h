// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lightwell {

/// The linear value of an sRGB-encoded one, both in [0, 1] (IEC 61966-2-1).
inline float srgb_to_linear(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// The sRGB encoding of a linear value, both in [0, 1] (IEC 61966-2-1).
inline float linear_to_srgb(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// The linear value of an 8-bit sRGB one.
inline float srgb_to_linear(uint8_t encoded) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> linear;
    for (size_t i = 0; i < linear.size(); i++) linear[i] = srgb_to_linear(static_cast<float>(i) / 255);
    return linear;
  }();
  return table[encoded];
}

/// The nearest 8 bits of a value, which is clamped to [0, 1].
inline uint8_t to_byte(float value) { return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255)); }

}  // namespace lightwell
