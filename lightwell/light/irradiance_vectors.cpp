// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/irradiance_vectors.h"

#include <algorithm>

namespace lightwell {
namespace {

/// The mixed moment of two different axes.
size_t mixed(int a, int b) { return static_cast<size_t>(5 + a + b); }

/// The light of one colour along one axis.
struct Along {
  float positive = 0, negative = 0;  // E of the two directions

  float flux() const { return positive - negative; }
  float both() const { return positive + negative; }
  /// How far the two directions could have different shares of what crosses the axis: not at all when one is dark.
  float slack() const { return both() > 0 ? positive * negative / both() : 0; }
  float balance() const { return both() > 0 ? flux() / both() : 0; }
};

/// The components across two axes, a of b's vectors and b of a's: the differences between those of the positive and
/// the negative direction. Each vector has of the flux as much as of its direction's E; what the mixed moment then
/// lacks is taken from where both directions are lit.
std::array<float, 2> differences(const Along& a, const Along& b, float mixed_moment) {
  std::array<float, 2> across{b.flux() * a.balance(), a.flux() * b.balance()};
  const float lacking = 2 * mixed_moment - across[0] - across[1];
  const float slack = a.slack() + b.slack();
  const float share = slack > 0 ? a.slack() / slack : 0.5f;
  across[0] += lacking * share;
  across[1] += lacking * (1 - share);
  return across;
}

}  // namespace

IrradianceVectors vectors_of(const Moments& moments) {
  IrradianceVectors vectors;
  for (int c = 0; c < 3; c++) {
    const auto component = [&](int axis, bool negative, int b) -> float& {
      return vectors.v[static_cast<size_t>(2 * axis + negative)][static_cast<size_t>(c)][b];
    };
    const auto along = [&](int axis) {
      const auto d = static_cast<size_t>(2 * axis);
      return Along{moments.m[d][c], moments.m[d + 1][c]};
    };
    const auto set_across = [&](int axis, int b, float difference) {
      component(axis, false, b) = 0.5f * (along(b).flux() + difference);
      component(axis, true, b) = 0.5f * (along(b).flux() - difference);
    };
    for (int a = 0; a < 3; a++) {
      component(a, false, a) = along(a).positive;
      component(a, true, a) = -along(a).negative;
      for (int b = a + 1; b < 3; b++) {
        const auto [of_a, of_b] = differences(along(a), along(b), moments.m[mixed(a, b)][c]);
        set_across(a, b, of_a);
        set_across(b, a, of_b);
      }
    }
  }
  return vectors;
}

Moments moments_of(const IrradianceVectors& vectors) {
  Moments moments;
  for (int c = 0; c < 3; c++) {
    const auto of = [&](size_t d) { return vectors.v[d][static_cast<size_t>(c)]; };
    for (int a = 0; a < 3; a++) {
      const auto d = static_cast<size_t>(2 * a);
      moments.m[d][c] = std::max(of(d)[a], 0.0f);
      moments.m[d + 1][c] = std::max(-of(d + 1)[a], 0.0f);
      for (int b = a + 1; b < 3; b++) {
        const auto e = static_cast<size_t>(2 * b);
        moments.m[mixed(a, b)][c] = 0.5f * (of(d)[b] - of(d + 1)[b] + of(e)[a] - of(e + 1)[a]);
      }
    }
  }
  return moments;
}

}  // namespace lightwell
