// SPDX-License-Identifier: Apache-2.0
//
// The record LightRecord::moments: 18 numbers of steps of the logarithm of E, 9 of the share that S has of (M_a +
// M_b)/2, which it never exceeds. To the scaled E 2^-4 is added, below which nothing is told apart: a 16,000th of the
// largest.
#include <algorithm>
#include <bit>
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/base/power_of_two.h"
#include "lightwell/light/lattice_record.h"
#include "lightwell/light/record.h"

namespace lightwell {
namespace {

/// Scaled E lies in [0, 2^10]; 2^-4 is added to it.
constexpr int lowest_octave = -4, octave_end = 11;

class MomentsRecordInSteps final : public LatticeRecord {
 public:
  MomentsRecordInSteps(int steps, float scale) : LatticeRecord(LightRecord::moments, scale), steps_(steps) {
    LW_ASSERT(steps >= least_steps && steps <= most_steps && (steps & (steps - 1)) == 0);
    for (size_t i = 0; i < 9; i++) {
      const bool mixed = i >= 6;
      add_colour({.least = mixed ? -steps : lowest_octave * steps,
                  .most = mixed ? steps : octave_end * steps - 1,
                  .models = static_cast<uint8_t>(mixed ? 3 : 0),
                  .begins = i == 0 || i == 6},
                 RecordNumber::Colour::follows);
    }
    // Square roots and products are rounded alike everywhere, powers are not.
    std::array<double, most_steps> powers{1};
    double root = 2;
    for (int half = steps / 2; half >= 1; half /= 2) {
      root = std::sqrt(root);
      for (int i = 0; i < steps; i += 2 * half)
        powers[static_cast<size_t>(i + half)] = powers[static_cast<size_t>(i)] * root;
    }
    for (size_t i = 0; i < static_cast<size_t>(steps); i++) fraction_[i] = static_cast<float>(powers[i]);
  }

  Moments decode(std::span<const int32_t> numbers) const override {
    Moments moments;
    for (size_t i = 0; i < 18; i++) moments.m[i / 3][coded_colours[i % 3]] = irradiance(numbers[i]);
    for (size_t pair = 0; pair < 3; pair++) {
      const Vec3f bound = mixed_bound(moments, pair) / static_cast<float>(steps_);
      for (size_t k = 0; k < 3; k++) {
        const int c = coded_colours[k];
        moments.m[6 + pair][c] = static_cast<float>(numbers[18 + 3 * pair + k]) * bound[c];
      }
    }
    return moments;
  }

 private:
  float irradiance(int32_t number) const {
    const int32_t octave = number >> std::countr_zero(static_cast<uint32_t>(steps_));  // rounded down
    const float power = power_of_two(octave) * fraction_[static_cast<size_t>(number - octave * steps_)];
    return std::max(power - moments_darkness, 0.0f) / scale_;
  }

  int32_t steps_;
  std::array<float, most_steps> fraction_{};  // 2^(i / steps)
};

}  // namespace

std::unique_ptr<const LatticeRecord> moments_record(int steps, float scale) {
  return std::make_unique<MomentsRecordInSteps>(steps, scale);
}

}  // namespace lightwell
