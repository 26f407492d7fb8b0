// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "lightwell/base/power_of_two.h"
#include "lightwell/base/vector.h"

namespace lightwell {

/// The multiples of 2^exponent. Those at most `limit` steps from zero are exact floats, so that value and code are
/// equivalent on every machine. Meshes of one exponent share their lattice, so that no crack opens between them.
struct Lattice {
  static constexpr int32_t limit = 1 << 23;
  static constexpr int min_exponent = -100, max_exponent = 104;

  int8_t exponent = 0;

  bool operator==(const Lattice&) const = default;
  float step() const { return power_of_two(exponent); }
  float value(int32_t code) const { return static_cast<float>(code) * step(); }
  /// The nearest code, clamped to the limit; exact for values on the lattice. NaN gives zero.
  int32_t code(float value) const;
  /// The code of a value that is known to be on the lattice and within the limit.
  int32_t exact_code(float value) const { return static_cast<int32_t>(value * power_of_two(-exponent)); }
};

/// A unit vector on the octahedral grid of 1023 x 1023 directions (10 bits an axis; Meyer et al., On Floating-Point
/// Normal Vectors, EGSR 2010), -511 ... 511.
struct NormalCode {
  int16_t u = 0, v = 0;

  bool operator==(const NormalCode&) const = default;
  auto operator<=>(const NormalCode&) const = default;
};

/// The code of the direction of n, whatever its length; a direction on the grid gives back its code. A vector that is
/// zero or not finite counts as +y.
NormalCode normal_code(const Vec3f& n);

/// The same for a vector of integers of any size, in integer arithmetic only; it predicts normals from the faces.
NormalCode normal_code(const Vec<int64_t, 3>& n);

/// The unit vector of a code.
Vec3f normal_of(NormalCode code);

/// A colour in 8 bits a channel: the square roots of linear red, green and blue, whose steps are about those of sRGB
/// even in the dark, and alpha as it is.
using ColorCode = std::array<uint8_t, 4>;
/// A linear colour in 65535ths.
using Color16 = std::array<uint16_t, 4>;

/// The nearest code of a linear colour. Channels are clamped to [0, 1]; NaN counts as 0.
ColorCode color_code(const Vec4f& color);
ColorCode color_code(const Color16& color);
/// The colour of a code; encoding it gives the code back.
Color16 color_value(const ColorCode& code);
/// A colour as numbers from 0 to 1.
inline Vec4f color_of(const Color16& c) {
  return Vec4f{{float(c[0]), float(c[1]), float(c[2]), float(c[3])}} / 65535.0f;
}

}  // namespace lightwell
