// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/material.h"

#include <gtest/gtest.h>

#include "lightwell/trace/gloss_share.h"
#include "lightwell/trace/sampling.h"
#include "lightwell/trace/texture_lookup.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

TEST(Surface, DividesABaseColourAsTheMetallicRoughnessModelDoes) {
  Material material;
  material.base_color = {{0.5f, 0.4f, 0.3f, 1}};
  material.metallic = 0.25f;
  material.specular = 0;
  const Surface surface = surface_of(material, {}, {}, Vec4f::filled(1));
  EXPECT_NEAR(surface.bsdf.diffuse[0], 0.375f, 1e-6f);
  EXPECT_NEAR(surface.bsdf.gloss[0], 0.125f, 1e-6f);
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

// A white furnace over the whole square: what passes and what is reflected is all, whatever part of the light a
// material's gloss, metal and transmission take.
TEST(Surface, OfWhitePassesOrReflectsAll) {
  for (const float specular : {0.0f, 0.5f, 1.0f}) {
    for (const float metallic : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
      for (const float transmission : {0.0f, 0.3f, 0.6f, 1.0f}) {
        for (const float cosine : {1.0f, 0.5f, 0.1f}) {
          SCOPED_TRACE(testing::Message() << specular << ' ' << metallic << ' ' << transmission << ' ' << cosine);
          Material material = lambertian(1);
          material.specular = specular;
          material.metallic = metallic;
          material.transmission = transmission;
          material.roughness = 0.7f;
          const Surface surface = surface_of(material, {}, {}, Vec4f::filled(1), cosine);
          const float met = surface.coverage, coat = gloss_share(cosine, 0.7f).of(0.04f, 1) * specular;
          EXPECT_NEAR(1 - met, (1 - metallic) * transmission * (1 - coat), 1e-5f);
          const Bsdf::Albedo albedo = surface.bsdf.albedo(cosine);
          EXPECT_NEAR(met * albedo.diffuse[0], (1 - metallic) * (1 - transmission) * (1 - coat), 1e-5f);
          EXPECT_NEAR(1 - met + met * albedo.total()[0], 1, 1e-5f);
        }
      }
    }
  }
}

// KHR_materials_specular and KHR_materials_ior: F0 = min(((ior - 1) / (ior + 1))^2 * specularColor, 1) * specular and
// F90 = specular, of the dielectric; a metal's are its colour and 1, and both are mixed.
TEST(Surface, HasTheGlossOfItsExtensions) {
  Random random(6, 0);
  for (int i = 0; i < 1000; i++) {
    Material material = lambertian(Vec3f{{random.uniform(), random.uniform(), random.uniform()}});
    material.metallic = i % 3 == 0 ? 0 : random.uniform();
    material.specular = i % 5 == 0 ? 1 : random.uniform();
    material.ior = i % 7 == 0 ? 0 : 1 + 3 * random.uniform();  // 0: reflects everything
    material.specular_color = Vec3f{{random.uniform(), 1, 20 * random.uniform()}};
    const Bsdf bsdf = surface_of(material, {}, {}, Vec4f::filled(1)).bsdf;
    const float fresnel = (material.ior - 1) * (material.ior - 1) / ((material.ior + 1) * (material.ior + 1));
    for (int c = 0; c < 3; c++) {
      const float dielectric = std::min(fresnel * material.specular_color[c], 1.0f) * material.specular;
      ASSERT_NEAR(bsdf.gloss[c], std::lerp(dielectric, material.base_color[c], material.metallic), 1e-6f);
    }
    ASSERT_NEAR(bsdf.grazing, std::lerp(material.specular, 1.0f, material.metallic), 1e-6f);
  }
  Material without = lambertian(1);
  without.specular = Material().specular;
  const Bsdf plain = surface_of(without, {}, {}, Vec4f::filled(1)).bsdf;
  EXPECT_NEAR(plain.gloss[0], 0.04f, 1e-6f);  // as of a material without the extensions
  EXPECT_EQ(plain.grazing, 1);
}

TEST(Surface, TakesGlossAndTransmissionFromTextures) {
  const std::vector<Image> images = {{1, 1, 4, {128, 0, 255, 51}}};
  Material material = lambertian(1);
  material.specular = 1;
  material.specular_texture.image = 0;
  EXPECT_NEAR(surface_of(material, images, {}, Vec4f::filled(1)).bsdf.grazing, 0.2f, 1e-6f);  // alpha, linear
  material.specular_texture.image = -1;
  material.specular_color_texture.image = 0;
  const Bsdf coloured = surface_of(material, images, {}, Vec4f::filled(1)).bsdf;
  EXPECT_NEAR(coloured.gloss[0] / 0.04f, 0.2159f, 1e-3f);  // 128 of sRGB
  EXPECT_EQ(coloured.gloss[1], 0);
  EXPECT_EQ(coloured.grazing, 1);
  material.specular = 0;
  material.transmission = 0.5f;
  material.transmission_texture.image = 0;
  EXPECT_NEAR(1 - surface_of(material, images, {}, Vec4f::filled(1)).coverage, 0.5f * 128 / 255, 1e-6f);  // red, linear
  EXPECT_TRUE(varies(material));
  EXPECT_FALSE(varies(lambertian(1)));
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
                  metal = surface.coverage * surface.bsdf.gloss[c];
      ASSERT_NEAR(diffuse, alpha * (1 - metallic) * (1 - transmission) * color[c], 1e-6f);
      ASSERT_NEAR(metal, alpha * metallic * color[c], 1e-6f);
      ASSERT_LE(surface.bsdf.diffuse[c] + std::max(surface.bsdf.gloss[c], surface.bsdf.grazing), 1 + 1e-5f);
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
