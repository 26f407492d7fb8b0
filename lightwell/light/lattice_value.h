// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "lightwell/light/grid.h"

namespace lightwell {

/// The light of a node in whole numbers: red, green, blue of the nine moments. An E is a number of steps of its
/// logarithm, a mixed moment a number of steps of its share of (M_a + M_b)/2, which it never exceeds.
struct LatticeValue {
  static constexpr size_t count = 27;
  static constexpr size_t irradiances = 18;

  std::array<int16_t, count> v{};
  bool valid = false;
};

/// The steps of LatticeValues: `steps` to an octave of E, and as many to a whole mixed moment. E is taken `scale`
/// times, and 2^-4 is added, below which nothing is told apart: a 16,000th of the largest E.
class LatticeSteps {
 public:
  static constexpr int least = 4, most = 256;

  LatticeSteps(int steps, float scale);

  /// The nearest value.
  LatticeValue encode(const Moments& moments) const;
  /// Finite for any value, and the same on every machine.
  Moments decode(const LatticeValue& value) const;
  /// The nearest number within the range of an entry, 0 ... 26.
  int16_t clamp(size_t entry, int32_t number) const;

 private:
  float irradiance(int32_t number) const;

  int steps_;
  float scale_;
  std::array<float, most> fraction_{};  // 2^(i / steps)
};

}  // namespace lightwell
