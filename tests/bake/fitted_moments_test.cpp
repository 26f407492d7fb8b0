// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/fitted_moments.h"

#include <gtest/gtest.h>

#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

constexpr float ambient = 0.3f;

/// The moments of light of irradiance 1 that comes from one direction (docs/light.md section 1), and of some from all.
Moments light_from(const Vec3f& w) {
  Moments moments;
  for (size_t d = 0; d < 6; d++) moments.m[d] = Vec3f::filled(ambient);
  const auto sign = [&](int a) { return w[a] < 0 ? -1.0f : 1.0f; };
  const auto mixed = [&](int a, int b) { return Vec3f::filled((sign(a) * w[b] + sign(b) * w[a]) / 2); };
  for (int a = 0; a < 3; a++) moments.m[static_cast<size_t>(2 * a + (w[a] < 0))] += Vec3f::filled(std::abs(w[a]));
  moments.m[6] = mixed(0, 1);
  moments.m[7] = mixed(0, 2);
  moments.m[8] = mixed(1, 2);
  return moments;
}

float received_from(const Vec3f& w, const Vec3f& normal) { return std::max(dot(w, normal), 0.0f) + ambient; }

std::array<Vec3f, 4> received_from(const Vec3f& w, const Facings& facings) {
  std::array<Vec3f, 4> received;
  for (size_t i = 0; i < facings.size(); i++) received[i] = Vec3f::filled(received_from(w, facings[i].normal));
  return received;
}

// Of light from one direction moments give up to a tenth too much or too little. A sixteenth of that is left for the
// surface that looks it up: a twentieth by design, more where its normal weighs less in the nine numbers (3/4 at
// least).
TEST(FittedMoments, AreRightForTheSurfaceThatLooksThemUp) {
  Random random(7, 0);
  for (int i = 0; i < 1000; i++) {
    const Vec3f w = sample_sphere(random), n = sample_sphere(random);
    Facings facings{};
    facings[0] = {n, 0.3f};
    const float right = received_from(w, n);
    const Moments before = light_from(w), after = fitted(before, facings, received_from(w, facings));
    const float error = std::abs(before.irradiance(n)[0] - right);
    EXPECT_LE(std::abs(after.irradiance(n)[0] - right), 0.07f * error + 1e-5f) << i;
  }
}

// Along an axis moments are exact, and stay as they are.
TEST(FittedMoments, StayWhereTheyAreRight) {
  Facings facings{};
  facings[0] = {{{0, 1, 0}}, 1};
  facings[1] = {{{-1, 0, 0}}, 0.5f};
  const Vec3f w = normalized(Vec3f{{-1, 2, 3}});
  const Moments before = light_from(w), after = fitted(before, facings, received_from(w, facings));
  for (size_t k = 0; k < before.m.size(); k++) EXPECT_NEAR(after.m[k][0], before.m[k][0], 1e-6f) << k;
  const Moments alone = fitted(before, Facings{}, received_from(w, facings));
  for (size_t k = 0; k < before.m.size(); k++) EXPECT_EQ(alone.m[k], before.m[k]);
}

// Normals that are the same, opposite or nearly so, and what no light could be: finite, E positive, S within its bound.
TEST(FittedMoments, StayWithinTheirBounds) {
  Random random(8, 0);
  for (int i = 0; i < 2000; i++) {
    Moments before = light_from(sample_sphere(random));
    Facings facings{};
    std::array<Vec3f, 4> received;
    const Vec3f n = sample_sphere(random);
    for (size_t k = 0; k < facings.size(); k++) {
      const Vec3f aside = sample_sphere(random) * (k % 2 == 0 ? 1e-3f : 0.0f);
      facings[k] = {normalized((random.uniform() < 0.5f ? n : -n) + aside),
                    random.uniform() < 0.2f ? 0 : random.uniform()};
      received[k] = Vec3f::filled(4 * random.uniform());
    }
    const Moments after = fitted(before, facings, received);
    for (size_t k = 0; k < 6; k++) EXPECT_GE(after.m[k][0], 0);
    constexpr std::array<std::array<size_t, 2>, 3> pairs{{{0, 1}, {0, 2}, {1, 2}}};
    for (size_t k = 0; k < 3; k++) {
      const auto [a, b] = pairs[k];
      const float bound = (after.m[2 * a] + after.m[2 * a + 1] + after.m[2 * b] + after.m[2 * b + 1])[0] / 2;
      EXPECT_LE(std::abs(after.m[6 + k][0]), bound * 1.0001f + 1e-6f);
    }
  }
}

}  // namespace
}  // namespace lightwell
