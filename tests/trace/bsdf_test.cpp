// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/bsdf.h"

#include <gtest/gtest.h>

#include "tests/trace/bsdfs.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/direction_bins.h"

namespace lightwell {
namespace {

const Vec3f up{{0, 1, 0}};

TEST(Bsdf, OfALambertianIsItsAlbedoOverPi) {
  const Bsdf bsdf = Bsdf::lambertian({{0.1f, 0.5f, 0.9f}});
  for (const float angle : {0.0f, 40.0f, 89.0f}) {
    EXPECT_EQ(bsdf.evaluate(up, tilted(30), tilted(angle)).value, (Vec3f{{0.1f, 0.5f, 0.9f}} / pi));
  }
  EXPECT_EQ(bsdf.evaluate(up, tilted(30), tilted(91)).value, Vec3f{});
}

TEST(Bsdf, IsReciprocal) {
  Random random(2, 0);
  for (const auto& [name, bsdf, white] : all_bsdfs({0.0f, 0.3f, 1.0f})) {
    for (int i = 0; i < 1000; i++) {
      const Vec3f a = sample_cosine_hemisphere(up, random), b = sample_cosine_hemisphere(up, random);
      const Vec3f there = bsdf.evaluate(up, a, b).value, back = bsdf.evaluate(up, b, a).value;
      for (int c = 0; c < 3; c++) ASSERT_NEAR(there[c], back[c], 1e-4f * there[c]) << name;
    }
  }
}

// What is sampled below the horizon has no density.
TEST(Bsdf, SamplesEveryPartOfTheHemisphereWithItsDensity) {
  for (const auto& [name, bsdf, white] : all_bsdfs({0.3f, 0.6f, 1.0f})) {
    if (white && bsdf.glossy()) continue;  // the colours choose other shares of the lobes
    for (const float angle : {0.0f, 45.0f, 80.0f}) {
      const Vec3f out = tilted(angle);
      const auto shares = DirectionBins::shares([&](const Vec3f& in) { return bsdf.evaluate(up, out, in).density; });
      std::vector<int> counts(shares.size());
      Random random(3, 0);
      for (int i = 0; i < 50000; i++) {
        const Bsdf::Sample sample = bsdf.sample(up, out, random);
        counts[sample.density > 0 ? DirectionBins::of(sample.in) : DirectionBins::without()]++;
      }
      EXPECT_GT(chi_square(counts, shares), least_probability) << name << " at " << angle;
    }
  }
}

// In a furnace of radiance 1 a white surface sends 1 to everywhere, and a coloured one its albedo, never more. The
// table of gloss_share() is good to 0.003; 40000 samples whose weights scatter by up to 0.5 to 0.0025, of which three
// times is allowed.
TEST(Bsdf, LosesNothingInAWhiteFurnace) {
  for (const auto& [name, bsdf, white] : all_bsdfs({0.0f, 0.3f, 0.6f, 1.0f})) {
    for (const float angle : {0.0f, 45.0f, 70.0f, 85.0f}) {
      const Vec3f out = tilted(angle);
      Vec3d sum{};
      Random random(1, 0);
      const int samples = 40000;
      for (int i = 0; i < samples; i++) sum += bsdf.sample(up, out, random).weight.cast<double>() / samples;
      const Vec3f albedo = bsdf.albedo(out[1]).total();
      for (int c = 0; c < 3; c++) {
        EXPECT_NEAR(sum[c], albedo[c], 0.0105) << name << " at " << angle;
        EXPECT_LE(albedo[c], 1 + 1e-5f) << name << " at " << angle;
        if (white) {
          EXPECT_NEAR(albedo[c], 1, 1e-5f) << name << " at " << angle;
        }
      }
    }
  }
}

// Schlick's reflectance of smooth plastic: F0 along the normal, and near 1 where the view grazes it.
TEST(Bsdf, ReflectsMoreAtGrazingAngles) {
  Material plastic = lambertian(0.5f);
  plastic.specular = 1;
  plastic.roughness = 0;
  const Bsdf bsdf = bsdf_of(plastic);
  EXPECT_NEAR(bsdf.albedo(1).gloss[0], 0.04f, 1e-3f);
  EXPECT_NEAR(bsdf.albedo(0.5f).gloss[0], 0.04f + 0.96f / 32, 3e-3f);  // 1 - cosine to the fifth
  EXPECT_GT(bsdf.albedo(0.05f).gloss[0], 0.6f);
}

}  // namespace
}  // namespace lightwell
