// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace lightwell {

/// The IEEE 754 half nearest to `value`, ties to even. Values beyond the range give the largest finite half, so that a
/// texture never holds an infinity; NaN gives 0.
inline uint16_t to_half(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const auto sign = static_cast<uint16_t>(bits >> 16 & 0x8000);
  const uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return 0;                                      // not a number
  if (magnitude >= 0x477ff000u) return static_cast<uint16_t>(sign | 0x7bff);  // 65520 and above
  if (magnitude < 0x38800000u) {                                              // subnormal: multiples of 2^-24
    const float scaled = std::bit_cast<float>(magnitude) + 0.5f;              // the sum rounds at 2^-24
    return static_cast<uint16_t>(sign | (std::bit_cast<uint32_t>(scaled) - 0x3f000000u));
  }
  const uint32_t rounded = magnitude + 0xfff + (magnitude >> 13 & 1);
  return static_cast<uint16_t>(sign | ((rounded - 0x38000000u) >> 13));
}

/// The float of a finite half.
inline float from_half(uint16_t half) {
  const uint32_t sign = static_cast<uint32_t>(half & 0x8000) << 16;
  const uint32_t magnitude = half & 0x7fff;
  if (magnitude < 0x400) {
    const float value = static_cast<float>(magnitude) * 0x1p-24f;
    return sign ? -value : value;
  }
  return std::bit_cast<float>(sign | ((magnitude << 13) + 0x38000000u));
}

}  // namespace lightwell
