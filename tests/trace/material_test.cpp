// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/material.h"

#include <gtest/gtest.h>

#include "lightwell/trace/sampling.h"
#include "lightwell/trace/texture_lookup.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

const Vec3f up{{0, 1, 0}};

Vec3f tilted(float degrees) {
  const float angle = degrees * pi / 180;
  return {{std::sin(angle), std::cos(angle), 0}};
}

Bsdf metal(float roughness) {
  return {.diffuse = Vec3f::filled(0.2f), .metal = Vec3f::filled(0.6f), .metallic = 0.75f, .roughness = roughness};
}

TEST(Bsdf, OfALambertianIsItsAlbedoOverPi) {
  const Bsdf bsdf = Bsdf::lambertian({{0.1f, 0.5f, 0.9f}});
  for (const float angle : {0.0f, 40.0f, 89.0f}) {
    EXPECT_EQ(bsdf.value(up, tilted(30), tilted(angle)), (Vec3f{{0.1f, 0.5f, 0.9f}} / pi));
  }
  EXPECT_EQ(bsdf.value(up, tilted(30), tilted(91)), Vec3f{});
}

TEST(Bsdf, IsReciprocal) {
  Random random(2, 0);
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    const Bsdf bsdf = metal(roughness);
    for (int i = 0; i < 1000; i++) {
      const Vec3f a = sample_cosine_hemisphere(up, random), b = sample_cosine_hemisphere(up, random);
      const float there = bsdf.value(up, a, b)[0], back = bsdf.value(up, b, a)[0];
      EXPECT_NEAR(there, back, 1e-5f * there) << roughness;
    }
  }
}

// Sampled directions counted in parts of the hemisphere, against the density summed up over each part. What is sampled
// below the horizon has no density.
TEST(Bsdf, SamplesEveryPartOfTheHemisphereWithItsDensity) {
  const int rows = 20, columns = 20, fine = 24;
  for (const float roughness : {0.3f, 0.6f, 1.0f}) {
    for (const float angle : {0.0f, 45.0f, 80.0f}) {
      const Bsdf bsdf = metal(roughness);
      const Vec3f out = tilted(angle);
      std::vector<double> shares(rows * columns + 1);
      double above = 0;
      for (int row = 0; row < rows * fine; row++) {
        for (int column = 0; column < columns * fine; column++) {
          const float height = (static_cast<float>(row) + 0.5f) / (rows * fine);
          const float turn = 2 * pi * (static_cast<float>(column) + 0.5f) / (columns * fine);
          const float radius = std::sqrt(1 - height * height);
          const Vec3f in{{radius * std::cos(turn), height, radius * std::sin(turn)}};
          const double share = static_cast<double>(bsdf.density(up, out, in) * 2 * pi) / (rows * columns * fine * fine);
          shares[static_cast<size_t>(row / fine * columns + column / fine)] += share;
          above += share;
        }
      }
      shares.back() = std::max(0.0, 1 - above);
      std::vector<int> counts(shares.size());
      Random random(3, 0);
      for (int i = 0; i < 50000; i++) {
        const Bsdf::Sample sample = bsdf.sample(up, out, random);
        size_t place = counts.size() - 1;
        if (sample.density > 0) {
          const float turn = std::atan2(sample.in[2], sample.in[0]) / (2 * pi);
          const int row = std::clamp(static_cast<int>(sample.in[1] * rows), 0, rows - 1);
          const int column = std::clamp(static_cast<int>((turn < 0 ? turn + 1 : turn) * columns), 0, columns - 1);
          place = static_cast<size_t>(row * columns + column);
        }
        counts[place]++;
      }
      EXPECT_LT(chi_square(counts, shares), 5) << roughness << " " << angle;
    }
  }
}

// The densities of all directions sum up to one, less what falls below the horizon; and what is reflected, found by
// sampling and by a sum over a fine grid of directions, is the same and never more than arrives.
TEST(Bsdf, SamplesWithItsDensityAndConservesEnergy) {
  for (const float roughness : {0.3f, 0.6f, 1.0f}) {
    for (const float angle : {0.0f, 45.0f, 80.0f}) {
      const Bsdf bsdf = metal(roughness);
      const Vec3f out = tilted(angle);
      double sampled = 0, above = 0;
      Random random(1, 0);
      const int samples = 100000;
      for (int i = 0; i < samples; i++) {
        const Bsdf::Sample sample = bsdf.sample(up, out, random);
        sampled += static_cast<double>(sample.weight[0]) / samples;
        above += sample.density > 0 ? 1.0 / samples : 0.0;
      }
      double summed = 0, densities = 0;
      const int heights = 400, turns = 600;
      for (int i = 0; i < heights * turns; i++) {
        const float height = (static_cast<float>(i % heights) + 0.5f) / heights;
        const float turn = 2 * pi * (static_cast<float>(i / heights) + 0.5f) / turns;
        const float radius = std::sqrt(1 - height * height);
        const Vec3f in{{radius * std::cos(turn), height, radius * std::sin(turn)}};
        const double solid_angle = 2 * static_cast<double>(pi) / (heights * turns);
        summed += static_cast<double>(bsdf.value(up, out, in)[0] * height) * solid_angle;
        densities += static_cast<double>(bsdf.density(up, out, in)) * solid_angle;
      }
      // 100000 samples of weights that scatter by up to 0.6 are good to 0.002; three times that.
      EXPECT_NEAR(sampled, summed, 0.006) << roughness << " " << angle;
      EXPECT_NEAR(densities, above, 0.006) << roughness << " " << angle;
      EXPECT_LT(sampled, 1.0);
      EXPECT_GT(sampled, 0.2);
    }
  }
}

TEST(Surface, DividesABaseColourAsTheMetallicRoughnessModelDoes) {
  Material material;
  material.base_color = {{0.5f, 0.4f, 0.3f, 1}};
  material.metallic = 0.25f;
  const Surface surface = surface_of(material, {}, {}, Vec4f::filled(1));
  EXPECT_NEAR(surface.bsdf.diffuse[0], 0.375f, 1e-6f);
  EXPECT_NEAR(surface.bsdf.metal[0], 0.125f, 1e-6f);
  EXPECT_EQ(surface.coverage, 1);
}

// What is met times what is then reflected is the untransmitted share of the colour.
TEST(Surface, OfAPaneReflectsWhatItDoesNotTransmit) {
  Material material = lambertian({{0.9f, 0.6f, 0.3f}});
  material.transmission = 0.5f;
  const Surface surface = surface_of(material, {}, {}, Vec4f::filled(1));
  EXPECT_NEAR(surface.coverage, 1 - 0.5f * 0.6f, 1e-6f);
  EXPECT_NEAR((surface.bsdf.diffuse * surface.coverage)[0], 0.45f, 1e-6f);
}

/// Mean weight of samples for light that arrives along the normal.
double sampled_reflectance(const Bsdf& bsdf) {
  const int samples = 50000;
  double sum = 0;
  Random random(4, 0);
  for (int i = 0; i < samples; i++) sum += static_cast<double>(bsdf.sample(up, up, random).weight[0]) / samples;
  return sum;
}

// A white furnace over the whole square: transmission takes from the dielectric's diffuse part and leaves the metal.
TEST(Surface, OfWhitePassesOrReflectsAllForAnyMetallicAndTransmission) {
  // What a white GGX lobe of alpha 1 reflects of light along its normal when each facet is met once: facets have a
  // cosine's density, a facet with cosine c turns the light to cos_in = 2 c^2 - 1, the shadowing of which is
  // 2 cos_in / (1 + cos_in), and the mean of that is 1 - ln 2.
  const double once = 1 - std::numbers::ln2;
  for (const float metallic : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    for (const float transmission : {0.0f, 0.3f, 0.6f, 1.0f}) {
      SCOPED_TRACE(testing::Message() << "metallic " << metallic << ", transmission " << transmission);
      Material material = lambertian(1);
      material.metallic = metallic;
      material.transmission = transmission;
      material.roughness = 1;
      const Surface surface = surface_of(material, {}, {}, Vec4f::filled(1));
      const float met = surface.coverage;
      EXPECT_NEAR(1 - met, (1 - metallic) * transmission, 1e-6f);
      EXPECT_NEAR(met * surface.bsdf.diffuse[0], (1 - metallic) * (1 - transmission), 1e-6f);
      EXPECT_NEAR(met * surface.bsdf.metal[0], metallic, 1e-6f);
      EXPECT_NEAR(met * surface.bsdf.metallic, metallic, 1e-6f);
      // The weights scatter by up to 0.36, so that 50000 of them are good to 0.0016; three times that.
      EXPECT_NEAR(static_cast<double>(met) * sampled_reflectance(surface.bsdf),
                  static_cast<double>((1 - metallic) * (1 - transmission)) + static_cast<double>(metallic) * once,
                  0.005);
    }
  }
}

// Any material passes and reflects what glTF says, for each colour: of the part that alpha covers the metallic share
// and the untransmitted rest of the dielectric, in the material's colour, and never more than arrives.
TEST(Surface, NeverGivesMoreThanArrives) {
  Random random(5, 0);
  // Ends of the range are as frequent as what lies between.
  const auto number = [&] { return std::clamp(3 * random.uniform() - 1, 0.0f, 1.0f); };
  for (int i = 0; i < 20000; i++) {
    Material material = lambertian(Vec3f{{number(), number(), number()}});
    material.metallic = number();
    material.transmission = number();
    material.alpha = Material::Alpha::blend;
    material.base_color[3] = number();
    const Surface surface = surface_of(material, {}, {}, Vec4f::filled(1));
    const float alpha = material.base_color[3], metallic = material.metallic, transmission = material.transmission;
    const Vec3f color{{material.base_color[0], material.base_color[1], material.base_color[2]}};
    if (surface.coverage > 0) {
      ASSERT_NEAR(surface.coverage, alpha * (1 - (1 - metallic) * transmission * mean_of_channels(color)), 1e-6f);
    }
    for (int c = 0; c < 3; c++) {
      const float passed = (1 - surface.coverage) * surface.tint[c];
      ASSERT_NEAR(passed, 1 - alpha + alpha * (1 - metallic) * transmission * color[c], 1e-6f);
      const float diffuse = surface.coverage * surface.bsdf.diffuse[c],
                  metal = surface.coverage * surface.bsdf.metal[c];
      ASSERT_NEAR(diffuse, alpha * (1 - metallic) * (1 - transmission) * color[c], 1e-6f);
      ASSERT_NEAR(metal, alpha * metallic * color[c], 1e-6f);
      ASSERT_LE(surface.bsdf.diffuse[c] + std::max(surface.bsdf.metal[c], surface.bsdf.metallic), 1 + 1e-5f);
    }
    ASSERT_TRUE(lets_light_pass(material));
  }
}

TEST(Texture, IsDecodedBeforeItIsInterpolated) {
  const std::vector<Image> images = {{2, 1, 3, {0, 0, 0, 255, 255, 255}}};
  TextureLookup lookup;
  lookup.image = 0;
  lookup.wrap_u = TextureLookup::Wrap::clamp;
  const auto at = [&](float u) { return look_up(lookup, images, {{{{u, 0.5f}}, {}}}, true)[0]; };
  EXPECT_EQ(at(0.25f), 0);
  EXPECT_NEAR(at(0.5f), 0.5f, 1e-6f);
  EXPECT_EQ(at(0.75f), 1);
  EXPECT_EQ(at(2.0f), 1);
  lookup.wrap_u = TextureLookup::Wrap::repeat;
  EXPECT_EQ(at(1.25f), 0);
  EXPECT_NEAR(at(1.0f), 0.5f, 1e-6f);
  lookup.wrap_u = TextureLookup::Wrap::mirror;
  EXPECT_EQ(at(1.25f), 1);
  EXPECT_EQ(at(-0.25f), 0);
  EXPECT_EQ(at(std::numeric_limits<float>::quiet_NaN()), at(0.25f));
}

}  // namespace
}  // namespace lightwell
