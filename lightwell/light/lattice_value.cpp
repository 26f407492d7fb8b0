// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/lattice_value.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/base/power_of_two.h"

namespace lightwell {
namespace {

/// Scaled E lies in [0, 2^10]; 2^-4 is added to it.
constexpr int lowest_octave = -4, octave_end = 11;
constexpr float darkness = 0x1p-4f;

constexpr std::array<std::array<size_t, 2>, 3> axis_pairs{{{0, 1}, {0, 2}, {1, 2}}};

Vec3f mixed_bound(const std::array<Vec3f, 9>& m, size_t pair) {
  const auto [a, b] = axis_pairs[pair];
  return (m[2 * a] + m[2 * a + 1] + m[2 * b] + m[2 * b + 1]) * 0.5f;
}

}  // namespace

LatticeSteps::LatticeSteps(int steps, float scale) : steps_(steps), scale_(scale) {
  LW_ASSERT(steps >= least && steps <= most && (steps & (steps - 1)) == 0);
  // Square roots and products are rounded alike everywhere, powers are not.
  std::array<double, most> powers{1};
  double root = 2;
  for (int half = steps / 2; half >= 1; half /= 2) {
    root = std::sqrt(root);
    for (int i = 0; i < steps; i += 2 * half)
      powers[static_cast<size_t>(i + half)] = powers[static_cast<size_t>(i)] * root;
  }
  for (size_t i = 0; i < static_cast<size_t>(steps); i++) fraction_[i] = static_cast<float>(powers[i]);
}

int16_t LatticeSteps::clamp(size_t entry, int32_t number) const {
  if (entry < LatticeValue::irradiances)
    return static_cast<int16_t>(std::clamp(number, lowest_octave * steps_, octave_end * steps_ - 1));
  return static_cast<int16_t>(std::clamp(number, -steps_, steps_));
}

float LatticeSteps::irradiance(int32_t number) const {
  const int32_t octave = (number >= 0 ? number : number - steps_ + 1) / steps_;
  const float power = power_of_two(octave) * fraction_[static_cast<size_t>(number - octave * steps_)];
  return std::max(power - darkness, 0.0f) / scale_;
}

LatticeValue LatticeSteps::encode(const Moments& moments) const {
  LatticeValue value{.v = {}, .valid = true};
  std::array<Vec3f, 9> decoded{};
  for (size_t i = 0; i < LatticeValue::irradiances; i++) {
    const float e = std::max(moments.m[i / 3][static_cast<int>(i % 3)] * scale_, 0.0f);
    value.v[i] = clamp(i, static_cast<int32_t>(std::lround(static_cast<float>(steps_) * std::log2(e + darkness))));
    decoded[i / 3][static_cast<int>(i % 3)] = irradiance(value.v[i]);
  }
  for (size_t i = LatticeValue::irradiances; i < LatticeValue::count; i++) {
    const int c = static_cast<int>(i % 3);
    const float bound = mixed_bound(decoded, i / 3 - 6)[c];
    const float share = bound > 0 ? std::clamp(moments.m[i / 3][c] / bound, -1.0f, 1.0f) : 0.0f;
    value.v[i] = clamp(i, static_cast<int32_t>(std::lround(static_cast<float>(steps_) * share)));
  }
  return value;
}

Moments LatticeSteps::decode(const LatticeValue& value) const {
  Moments moments;
  for (size_t i = 0; i < LatticeValue::irradiances; i++)
    moments.m[i / 3][static_cast<int>(i % 3)] = irradiance(clamp(i, value.v[i]));
  for (size_t pair = 0; pair < 3; pair++) {
    const Vec3f bound = mixed_bound(moments.m, pair) / static_cast<float>(steps_);
    for (int c = 0; c < 3; c++) {
      const size_t i = 3 * (6 + pair) + static_cast<size_t>(c);
      moments.m[6 + pair][c] = static_cast<float>(clamp(i, value.v[i])) * bound[c];
    }
  }
  return moments;
}

}  // namespace lightwell
