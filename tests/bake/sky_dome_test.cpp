// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/sky_dome.h"

#include <gtest/gtest.h>

#include "lightwell/scene/sky_map.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

constexpr float whole = 4 * std::numbers::pi_v<float>;

/// A block of a metre on a ground, in a dome.
Scene under(const Mesh& dome, const Material& material, float ground) {
  Scene scene = scene_of(block({{-0.5f, 0, -0.5f}}, {{0.5f, 1, 0.5f}}), lambertian(0.5f));
  add(scene, quad({{-ground, 0, -ground}}, {{0, 0, 2 * ground}}, {{2 * ground, 0, 0}}), lambertian(0.5f));
  add(scene, dome, material);
  return scene;
}

Material unlit(const Vec3f& color) {
  Material material = lambertian(color);
  material.unlit = true;
  return material;
}

/// The mean radiance of the environment over all directions.
Vec3f mean_of(const Environment& environment) {
  if (!environment.map) return environment.radiance;
  Vec3f sum{};
  const RadianceImage& map = *environment.map;
  for (size_t pixel = 0; pixel < map.pixels.size() / 3; pixel++)
    sum += pixel_radiance(map, pixel) * solid_angle(static_cast<int>(pixel / static_cast<size_t>(map.width)), map);
  return sum * (1 / whole);
}

TEST(SkyDome, ShiningOrUnlitBecomesTheEnvironment) {
  for (const Material& material : {lambertian(0, 1), unlit({{1, 1, 1}})}) {
    for (const float ground : {3.0f, 40.0f}) {
      for (const Mesh& dome : {sphere(20, 3), room({{-20, -20, -20}}, {{20, 20, 20}})}) {
        Scene scene = under(dome, material, ground);
        Report report;
        ASSERT_TRUE(take_sky_dome(scene, report));
        ASSERT_EQ(scene.instances.size(), 2u);
        EXPECT_EQ(scene.primitives.size(), 3u);
        EXPECT_NEAR(mean_of(scene.environment)[1], 1, 1e-3);
        EXPECT_EQ(report.warnings.size(), 1u);
      }
    }
  }
}

// The lower half of a hemisphere's sky is black. What lies within a pixel of the horizon, 1 % of all, is either.
TEST(SkyDome, MayBeAHemisphere) {
  Mesh dome = sphere(20, 4);
  std::erase_if(dome.faces, [&](const Face& face) {
    return std::ranges::any_of(face, [&](uint32_t vertex) { return dome.positions[vertex][1] < -0.01f; });
  });
  Scene scene = under(dome, lambertian(0, 2), 3);
  Report report;
  ASSERT_TRUE(take_sky_dome(scene, report));
  EXPECT_NEAR(mean_of(scene.environment)[0], 1, 0.05);
}

TEST(SkyDome, LeavesAnEnvironmentThatIsGiven) {
  Scene scene = under(sphere(20, 3), unlit({{1, 1, 1}}), 3);
  scene.environment.radiance = {{0, 0, 5}};
  Report report;
  ASSERT_TRUE(take_sky_dome(scene, report));
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(mean_of(scene.environment), (Vec3f{{0, 0, 5}}));
}

// Walls that are near are walls, lamps are lamps, and what does not shine is no sky.
TEST(SkyDome, IsFarAndAllAround) {
  const Mesh lamp = quad({{-9, 9, -9}}, {{18, 0, 0}}, {{0, 0, 18}});
  const std::vector<std::pair<Mesh, Material>> others = {{room({{-1, 0, -1}}, {{1, 2, 1}}), lambertian(0, 1)},
                                                         {lamp, lambertian(0, 1)},
                                                         {sphere(20, 3), lambertian(0.5f)},
                                                         {turned(sphere(0.2f, 2)), lambertian(0, 1)}};
  for (const auto& [mesh, material] : others) {
    Scene scene = under(mesh, material, 0.9f);
    Report report;
    ASSERT_TRUE(take_sky_dome(scene, report));
    EXPECT_EQ(scene.instances.size(), 3u);
    EXPECT_TRUE(report.warnings.empty());
    EXPECT_EQ(mean_of(scene.environment), Vec3f{});
  }
}

}  // namespace
}  // namespace lightwell
