// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lights.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

/// Direct irradiance at a point, from `count` samples of the lights alone; nothing is in the way.
Vec3f irradiance(const Lights& lights, const Vec3f& point, const Vec3f& normal, int count) {
  Vec3d sum{};
  for (int i = 0; i < count; i++) {
    Random random(1, static_cast<uint64_t>(i));
    const Arrival arrival = lights.sample(point, random);
    if (arrival.density > 0)
      sum += (arrival.radiance * (std::max(0.0f, dot(normal, arrival.direction)) / arrival.density)).cast<double>();
  }
  return (sum / count).cast<float>();
}

Scene floor_scene() { return scene_of(quad({{-5, 0, -5}}, {{0, 0, 10}}, {{10, 0, 0}}), lambertian(0.5f)); }

const Vec3f up{{0, 1, 0}};

TEST(Lights, OfASceneWithoutThemAreDark) {
  const Scene scene = floor_scene();
  EXPECT_TRUE(world_of(scene)->lights().dark());
}

TEST(Lights, APointLampFallsOffWithDistanceAndRange) {
  Scene scene = floor_scene();
  scene.lamps = {point_lamp({{0, 2, 0}}, {{8, 4, 2}})};
  EXPECT_NEAR(irradiance(world_of(scene)->lights(), {}, up, 1)[0], 2, 1e-5f);
  // KHR_lights_punctual: max(min(1 - (distance / range)^4, 1), 0) / distance^2.
  scene.lamps[0].range = 4;
  EXPECT_NEAR(irradiance(world_of(scene)->lights(), {}, up, 1)[1], 15.0f / 16, 1e-5f);
  scene.lamps[0].range = 1.5f;
  EXPECT_EQ(irradiance(world_of(scene)->lights(), {}, up, 1), Vec3f{});
}

TEST(Lights, ASpotFadesBetweenItsCones) {
  Scene scene = floor_scene();
  scene.lamps = {spot_lamp({{0, 1, 0}}, 1, 0.2f, 0.6f)};
  const auto world = world_of(scene);
  const auto facing = [&](float angle) {
    const Vec3f point{{std::tan(angle), 0, 0}};
    const Vec3f way = scene.lamps[0].position - point;
    return irradiance(world->lights(), point, normalized(way), 1)[0] * dot(way, way);
  };
  EXPECT_NEAR(facing(0.1f), 1, 1e-5f);
  EXPECT_EQ(facing(0.65f), 0);
  const float x = (std::cos(0.4f) - std::cos(0.6f)) / (std::cos(0.2f) - std::cos(0.6f));
  EXPECT_NEAR(facing(0.4f), x * x, 1e-4f);
}

TEST(Lights, ASunIsTheIrradianceThatFacesIt) {
  Scene scene = floor_scene();
  scene.lamps = {sun_lamp({{0.6f, -0.8f, 0}}, 3)};
  EXPECT_NEAR(irradiance(world_of(scene)->lights(), {}, up, 1)[0], 2.4f, 1e-5f);
}

// A disc or square of small size a at distance d on axis: pi L a^2 / d^2 in the limit; a 2 cm square at 1 m is within
// 1e-4 of L * area / d^2, and the spread of the samples is of the same order.
TEST(Lights, ASmallLampIsFoundOnAxisAndNotFromBehind) {
  Scene scene = floor_scene();
  add(scene, quad({{-0.01f, 1, -0.01f}}, {{0.02f, 0, 0}}, {{0, 0, 0.02f}}), lambertian(0, 1000));
  const auto world = world_of(scene);
  EXPECT_NEAR(irradiance(world->lights(), {}, up, 1000)[0], 0.4f, 2e-4f);
  EXPECT_EQ(irradiance(world->lights(), {{0, 2, 0}}, -up, 100), Vec3f{});
  scene.materials.back().double_sided = true;
  EXPECT_NEAR(irradiance(world_of(scene)->lights(), {{0, 2, 0}}, -up, 1000)[0], 0.4f, 2e-4f);
}

// A constant sky gives pi L to an open plane; 20000 samples of a uniform sphere scatter by 1.3 / sqrt(20000) = 1 %.
TEST(Lights, AConstantEnvironmentGivesPiTimesItsRadiance) {
  Scene scene = floor_scene();
  scene.environment.radiance = {{1, 2, 3}};
  const Vec3f e = irradiance(world_of(scene)->lights(), {}, up, 20000);
  EXPECT_NEAR(e[0] / pi, 1, 0.03f);
  EXPECT_NEAR(e[2] / e[0], 3, 1e-4f);
}

// A lamp is never lost because nobody looked where it shines: one bright texel of 64 x 64, and a mask whose holes lie
// at the middle of both faces.
TEST(Lights, FindsTheLitPartOfATexture) {
  Scene scene = floor_scene();
  Mesh screen = quad({{0, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}});
  screen.texcoords[0] = {{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}};
  add(scene, screen, lambertian(0, 1000));
  Material& material = scene.materials.back();
  material.emission_texture.image = 0;
  material.emission_texture.wrap_u = material.emission_texture.wrap_v = TextureLookup::Wrap::clamp;
  scene.images = {{64, 64, 1, std::vector<uint8_t>(64 * 64)}};
  EXPECT_TRUE(world_of(scene)->lights().dark());
  scene.images[0].pixels[64 * 50 + 7] = 255;
  const auto world = world_of(scene);
  ASSERT_FALSE(world->lights().dark());
  double flux = 0;
  const int count = 400000;
  for (int i = 0; i < count; i++) {
    Random random(6, static_cast<uint64_t>(i));
    flux += static_cast<double>(world->lights().emit(random).flux[0]) / count;
  }
  // pi * 1000 of one texel in 4096, which one photon in 2048 meets: 4 / sqrt(195) of it.
  EXPECT_NEAR(flux / (static_cast<double>(pi) * 1000 / 4096), 1, 0.3);

  material.emission_texture.image = -1;
  material.alpha = Material::Alpha::mask;
  material.base_color_texture.image = 0;
  Image mask{3, 3, 2, std::vector<uint8_t>(18, 255)};
  for (const size_t hole : {2u, 4u, 6u}) mask.pixels[2 * hole + 1] = 0;
  scene.images = {mask};
  EXPECT_FALSE(world_of(scene)->lights().dark());
}

// Photons of all kinds of sources carry their power on average.
TEST(Lights, EmitTheirPower) {
  Scene scene = floor_scene();
  scene.environment.radiance = Vec3f::filled(0.02f);
  scene.lamps = {point_lamp({{0, 2, 0}}, {{8, 4, 2}}), spot_lamp({{1, 2, 0}}, 20, 0.1f, 0.9f),
                 sun_lamp({{0, -1, 0}}, 0.3f)};
  Material lamp = lambertian(0, 2);
  lamp.double_sided = true;
  add(scene, quad({{0, 4, 0}}, {{1, 0, 0}}, {{0, 0, 1}}), lamp);
  const auto world = world_of(scene);
  const Lights& lights = world->lights();
  ASSERT_EQ(lights.luminaires().size(), 5u);
  std::vector<double> flux(5);
  const int count = 200000;
  for (int i = 0; i < count; i++) {
    Random random(3, static_cast<uint64_t>(i));
    const Emission emission = lights.emit(random);
    flux[static_cast<size_t>(emission.luminaire)] += static_cast<double>(emission.flux[0]) / count;
  }
  const float radius = length(lights.region().size()) / 2;
  EXPECT_NEAR(lights.luminaires()[2].power[0], 0.3f * pi * radius * radius, 1e-2f);
  EXPECT_NEAR(lights.luminaires()[3].power[0], 2 * 2 * pi, 1e-4f);
  // Each is chosen by about a fifth of the photons or more: 4 / sqrt(40000) = 2 %, and the spot's edge scatters a
  // little more.
  for (size_t i = 0; i < 5; i++) {
    EXPECT_NEAR(flux[i] / static_cast<double>(lights.luminaires()[i].power[0]), 1, 0.04) << i;
  }
}

TEST(Lights, BeyondAFloatAreRefused) {
  const Scene scene = scene_of(quad({{0, 0, 0}}, {{1e8f, 0, 0}}, {{0, 1e8f, 0}}), lambertian(0, 1e30f));
  const auto result = World::build(scene);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message(), "lights: they are too bright: their power is beyond a float");
}

TEST(Lights, CountConnectedPiecesAsLuminaires) {
  Scene scene = floor_scene();
  Mesh lamps = quad({{0, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}});
  append(lamps, quad({{3, 3, 0}}, {{1, 0, 0}}, {{0, 0, 2}}));
  add(scene, lamps, lambertian(0, 1));
  const auto world = world_of(scene);
  const auto& all = world->lights().luminaires();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].faces, (std::vector<uint32_t>{0, 1}));
  EXPECT_NEAR(all[1].area, 2, 1e-6f);
  EXPECT_NEAR(length(all[1].center - Vec3f{{3.5f, 3, 1}}), 0, 1e-5f);
}

}  // namespace
}  // namespace lightwell
