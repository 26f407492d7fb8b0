// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/sun_of_sky.h"

#include <gtest/gtest.h>

#include <functional>

#include "lightwell/scene/builtin.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/sky_map.h"

namespace lightwell {
namespace {

Environment painted(const std::function<Vec3f(const Vec3f&)>& radiance, int height = 256) {
  auto map = std::make_shared<RadianceImage>(RadianceImage{2 * height, height, {}});
  map->pixels.resize(static_cast<size_t>(6 * height * height));
  for (size_t i = 0; i < map->pixels.size() / 3; i++) {
    const Vec3f colour = radiance(pixel_direction(*map, i));
    for (int c = 0; c < 3; c++) map->pixels[3 * i + static_cast<size_t>(c)] = colour[c];
  }
  return {Vec3f::filled(1), map};
}

/// The sum of radiance times solid angle over a picture, W/m2.
Vec3f flux(const Environment& environment) {
  Vec3f sum{};
  const RadianceImage& map = *environment.map;
  for (size_t i = 0; i < map.pixels.size() / 3; i++)
    sum += pixel_radiance(map, i) * solid_angle(static_cast<int>(i / static_cast<size_t>(map.width)), map);
  return sum * environment.radiance;
}

const Vec3f blue{{0.3f, 0.4f, 0.6f}}, white{{4000, 3800, 3400}};

/// A blue sky with a white disc.
Environment sky(const Vec3f& sun, float radius) {
  return painted([=](const Vec3f& d) { return dot(d, sun) > std::cos(radius) ? white : blue; });
}

TEST(SunOfSky, BecomesALampOfTheSameLight) {
  for (const Vec3f& towards : {normalized(Vec3f{{1, 2, 0.5f}}), normalized(Vec3f{{-0.2f, 0.1f, -1}}),
                               normalized(Vec3f{{0.02f, 1, 0}}), normalized(Vec3f{{0, 0.3f, 1}})}) {
    Environment environment = sky(towards, 0.03f);
    environment.radiance = {{2, 2, 2}};
    const Vec3f before = flux(environment);
    const auto sun = take_sun(environment);
    ASSERT_TRUE(sun);
    EXPECT_EQ(sun->kind, Lamp::Kind::sun);
    // Pixels of 0.7 degrees.
    EXPECT_GT(dot(-sun->direction, towards), std::cos(0.012f));
    const Vec3f after = flux(environment) + sun->intensity;
    for (int c = 0; c < 3; c++) EXPECT_NEAR(after[c] / before[c], 1, 1e-3f);  // sums of 131,072 floats
    const Vec3f sky_alone = blue * (8 * std::numbers::pi_v<float>);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(flux(environment)[c] / sky_alone[c], 1, 1e-3f);
    EXPECT_FALSE(take_sun(environment)) << "there is one sun";
  }
}

TEST(SunOfSky, IsNotFoundWhereThereIsNone) {
  Environment constant{blue, nullptr};
  EXPECT_FALSE(take_sun(constant));
  Environment uniform = painted([](const Vec3f&) { return blue; });
  Environment black = painted([](const Vec3f&) { return Vec3f{}; });
  Environment softbox = sky({{0, 1, 0}}, 0.3f);
  // A lamp of a street by night that sends little.
  Environment faint = painted([](const Vec3f& d) { return d[1] > std::cos(0.01f) ? blue * 60.0f : blue; });
  Environment clouds = painted([](const Vec3f& d) { return blue * (2 + std::sin(20 * d[0]) * std::sin(30 * d[2])); });
  for (Environment* environment : {&uniform, &black, &softbox, &faint, &clouds}) {
    const auto before = environment->map;
    EXPECT_FALSE(take_sun(*environment));
    EXPECT_EQ(environment->map, before);
  }
}

TEST(SunOfSky, StaysInTheDocument) {
  Report report;
  Scene scene = scene_from_document(find_builtin_scene("box-small")->make(1), "box", report).value();
  const size_t before = scene.lamps.size();
  Environment environment = sky(normalized(Vec3f{{1, 2, 0.5f}}), 0.03f);
  const Lamp sun = *take_sun(environment);
  add_sun(scene, sun);
  add_sun(scene, sun);
  ASSERT_EQ(scene.lamps.size(), before + 1);
  auto again = scene_from_document(scene.document, "again", report);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->lamps.size(), before + 1);
  const Lamp& read = again->lamps.back();
  EXPECT_EQ(read.node, scene.lamps.back().node);
  EXPECT_GT(dot(read.direction, sun.direction), 0.999999f);
  for (int c = 0; c < 3; c++) EXPECT_NEAR(read.intensity[c] / sun.intensity[c], 1, 1e-5f);
  add_sun(*again, sun);
  EXPECT_EQ(again->lamps.size(), before + 1) << "a pack that is opened beside its sky has its sun already";
}

}  // namespace
}  // namespace lightwell
