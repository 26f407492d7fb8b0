// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/material.h"

#include <gtest/gtest.h>

#include "lightwell/trace/sampling.h"
#include "lightwell/trace/texture_lookup.h"
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
  const Bsdf bsdf = metal(0.5f);
  const Vec3f a = tilted(20), b = normalized(Vec3f{{0.3f, 0.4f, 0.8f}});
  EXPECT_NEAR(bsdf.value(up, a, b)[0], bsdf.value(up, b, a)[0], 1e-6f);
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
