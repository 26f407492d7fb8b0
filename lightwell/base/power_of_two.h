// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace lightwell {

/// 2^exponent, for an exponent from -126 to 127.
constexpr float power_of_two(int exponent) { return std::bit_cast<float>(static_cast<uint32_t>(exponent + 127) << 23); }

/// True for 2 to a whole power; false for infinities, NaN and what is not positive.
inline bool is_power_of_two(float value) {
  int power;
  return value > 0 && std::isfinite(value) && std::frexp(value, &power) == 0.5f;
}

}  // namespace lightwell
