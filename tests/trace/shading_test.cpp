// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/shading.h"

#include <gtest/gtest.h>

#include "tests/trace/bsdfs.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/direction_bins.h"

namespace lightwell {
namespace {

const Vec3f up{{0, 1, 0}};

/// A surface that faces up, seen from `from` degrees to one side, whose shading normal leans `lean` degrees that way.
Shading leaning(const Bsdf& bsdf, float lean, float from) {
  return {.bsdf = bsdf, .normal = up, .shading_normal = facing(tilted(lean), tilted(from)), .out = tilted(from)};
}

TEST(Shading, IsTheBsdfWhereTheNormalsAreTheSame) {
  for (const auto& [name, bsdf, white] : all_bsdfs({0.4f})) {
    const Shading shading = leaning(bsdf, 0, 30);
    Random random(1, 0), same(1, 0);
    for (int i = 0; i < 100; i++) {
      const Vec3f in = sample_cosine_hemisphere(up, random);
      same = random;
      const Bsdf::Evaluation found = bsdf.evaluate(up, shading.out, in);
      ASSERT_EQ(shading.evaluate(in).reflectance, found.value * dot(up, in)) << name;
      ASSERT_EQ(shading.evaluate(in).density, found.density) << name;
      ASSERT_EQ(shading.sample(random).in, bsdf.sample(up, shading.out, same).in) << name;
    }
  }
}

// However far the normal leans, towards who looks or away, white sends 1 to everywhere in a furnace; nothing comes from
// below the surface, and nothing is black. The tolerance is that of the test of the BSDF.
TEST(Shading, LosesNothingInAWhiteFurnace) {
  for (const auto& [name, bsdf, white] : all_bsdfs({0.1f, 0.5f, 1.0f})) {
    if (!white) continue;
    for (const float lean : {-60.0f, -20.0f, 5.0f, 30.0f, 75.0f}) {
      for (const float from : {0.0f, 50.0f, 80.0f}) {
        const Shading shading = leaning(bsdf, lean, from);
        double sum = 0;
        Random random(1, 0);
        const int samples = 20000;
        for (int i = 0; i < samples; i++) {
          const Bsdf::Sample sample = shading.sample(random);
          sum += static_cast<double>(sample.weight[0]) / samples;
          ASSERT_TRUE(sample.weight[0] <= 0 || dot(up, sample.in) >= 0) << name;
        }
        EXPECT_NEAR(sum, 1, 0.015) << name << " leaning " << lean << " from " << from;
      }
    }
  }
}

TEST(Shading, SamplesEveryPartOfTheHemisphereWithItsDensity) {
  for (const auto& [name, bsdf, white] : all_bsdfs({0.5f})) {
    if (white) continue;
    for (const float lean : {-40.0f, 20.0f, 70.0f}) {
      const Shading shading = leaning(bsdf, lean, 40);
      const auto shares = DirectionBins::shares([&](const Vec3f& in) { return shading.evaluate(in).density; });
      std::vector<int> counts(shares.size());
      Random random(4, 0);
      for (int i = 0; i < 50000; i++) {
        const Bsdf::Sample sample = shading.sample(random);
        counts[sample.density > 0 ? DirectionBins::of(sample.in) : DirectionBins::without()]++;
      }
      EXPECT_GT(chi_square(counts, shares), least_probability) << name << " leaning " << lean;
    }
  }
}

TEST(Facing, TurnsANormalNoFartherThanItMust) {
  EXPECT_EQ(facing(tilted(80), tilted(0)), tilted(80));
  Random random(5, 0);
  for (int i = 0; i < 1000; i++) {
    const Vec3f normal = sample_sphere(random), out = sample_sphere(random);
    const Vec3f turned = facing(normal, out);
    ASSERT_NEAR(length(turned), 1, 1e-5f);
    ASSERT_GT(dot(turned, out), 0.009f);
    ASSERT_TRUE(dot(normal, out) <= 0.011f || turned == normal);
    ASSERT_NEAR(dot(cross(normal, out), turned), 0, 1e-5f);  // in the plane of both
  }
  EXPECT_EQ(facing(-up, up), up);
}

}  // namespace
}  // namespace lightwell
