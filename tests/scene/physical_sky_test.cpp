// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/physical_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lightwell/scene/builtin.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/noted_sky.h"
#include "lightwell/scene/sky_map.h"

namespace lightwell {
namespace {

constexpr double pi = std::numbers::pi;
const Vec3d luminance{{0.2126, 0.7152, 0.0722}};

/// A white sun at so many degrees above the horizon, over the map's middle unless it is turned.
Lamp sun_at(double degrees, double turn = 0) {
  Lamp sun;
  sun.kind = Lamp::Kind::sun;
  const double height = degrees * pi / 180, across = std::cos(height);
  sun.direction = -Vec3d{{across * std::sin(turn), std::sin(height), -across * std::cos(turn)}}.cast<float>();
  sun.intensity = Vec3f::filled(1);
  return sun;
}

/// The sum over the upper half of a picture of radiance, solid angle and, with `facing`, the cosine to the zenith.
Vec3d above(const RadianceImage& map, bool facing = true) {
  Vec3d sum{};
  for (size_t i = 0; i < map.pixels.size() / 6; i++) {
    const double angle = solid_angle(static_cast<int>(i / static_cast<size_t>(map.width)), map);
    const double cosine = pixel_direction(map, i)[1];
    sum += pixel_radiance(map, i).cast<double>() * (facing ? angle * cosine : angle);
  }
  return sum;
}

Vec3d at(const RadianceImage& map, int row, int column) {
  return pixel_radiance(map, static_cast<size_t>(row) * static_cast<size_t>(map.width) + static_cast<size_t>(column))
      .cast<double>();
}

int row_at(const RadianceImage& map, double degrees) { return static_cast<int>((90 - degrees) / 180 * map.height); }

/// The optical thickness of pure air above the ground: scattering by the scale height of 8 km, and ozone, a tent of 30
/// km.
const Vec3d rayleigh = Vec3d{{5.802e-3, 13.558e-3, 33.1e-3}} * 8.0,
            ozone = Vec3d{{0.650e-3, 1.881e-3, 0.085e-3}} * 15.0;

Vec3d through(const Vec3d& thickness, double way) {
  return {{std::exp(-thickness[0] * way), std::exp(-thickness[1] * way), std::exp(-thickness[2] * way)}};
}

// Eddington's approximation of all orders of scattering in a plane layer of air that takes nothing, over a ground that
// reflects a tenth (Shettle and Weinman, Journal of the Atmospheric Sciences 27, 1970). It is good to a few percent, as
// is Hillaire's of the light that is scattered again; ozone takes 3 % of the green.
TEST(PhysicalSky, OfPureAirIsThatOfALayerThatScatters) {
  for (const double degrees : {90.0, 60.0}) {
    const RadianceImage map = *physical_sky(sun_at(degrees), 1).map;
    const double height = std::sin(degrees * pi / 180);
    const Vec3d outside = through(ozone, 1 / height) * (height / dot(luminance, through(rayleigh + ozone, 1 / height)));
    const Vec3d direct = through(rayleigh, 1 / height), sky = above(map);
    for (int c = 0; c < 3; c++) {
      const double thickness = rayleigh[c] + 4 / 3.0;
      const double layer = (2 / 3.0 + height + (2 / 3.0 - height) * direct[c]) / thickness;
      const double total = layer / (1 - 0.1 * rayleigh[c] / thickness);
      EXPECT_NEAR(sky[c] / (outside[c] * (total - direct[c])), 1, 0.05) << degrees;
    }
  }
}

TEST(PhysicalSky, ThePictureBelowIsTheGroundInThisLight) {
  for (const double degrees : {90.0, 30.0}) {
    const RadianceImage map = *physical_sky(sun_at(degrees), 1).map;
    const double height = std::sin(degrees * pi / 180);
    const Vec3d left = through(rayleigh + ozone, 1 / height);
    const Vec3d expected = (above(map) + left * height / dot(luminance, left)) * (0.1 / pi);
    // The air is round, and its integral a sum of 32 pieces.
    for (int c = 0; c < 3; c++) EXPECT_NEAR(at(map, map.height - 1, 17)[c] / expected[c], 1, 0.01);
    EXPECT_EQ(at(map, map.height / 2, 0), at(map, map.height - 1, 500));
  }
}

// No more comes down than came in, and haze takes from the sun what it gives to the sky. On clear days the sky gives a
// tenth to a quarter of the light of a high sun (Coulson, Solar and Terrestrial Radiation, 1975, section 5).
TEST(PhysicalSky, TheSkysShareGrowsWithHaze) {
  double before = 0;
  for (const float turbidity : {1.0f, 2.0f, 3.0f, 6.0f, 10.0f}) {
    const double share = dot(luminance, above(*physical_sky(sun_at(60), turbidity).map)) / std::sin(pi / 3);
    EXPECT_GT(share, 1.2 * before) << turbidity;
    if (turbidity == 2 || turbidity == 3) {
      EXPECT_GT(share, 0.1);
      EXPECT_LT(share, 0.33);
    }
    before = share;
  }
}

TEST(PhysicalSky, IsTheSameOnBothSidesOfTheSun) {
  const RadianceImage map = *physical_sky(sun_at(35), 3).map;
  for (const int row : {3, 100, 180, 250})
    for (const int column : {0, 40, 300, 511})
      for (int c = 0; c < 3; c++) {
        const double left = at(map, row, column)[c], right = at(map, row, map.width - 1 - column)[c];
        EXPECT_NEAR(left, right, 1e-4 * right);  // directions are floats
      }
}

TEST(PhysicalSky, TurnsWithTheSun) {
  const RadianceImage map = *physical_sky(sun_at(35), 3).map;
  const RadianceImage turned = *physical_sky(sun_at(35, pi / 2), 3).map;
  for (const int row : {3, 100, 180, 250})
    for (const int column : {0, 40, 300, 767})
      EXPECT_NEAR(at(map, row, column)[1], at(turned, row, column + 256)[1], 1e-4 * at(map, row, column)[1]);
}

TEST(PhysicalSky, IsBrighterAroundTheSunAndBlueAwayFromIt) {
  const RadianceImage map = *physical_sky(sun_at(40), 3).map;
  const int row = row_at(map, 40), middle = map.width / 2;
  for (int away = 1; away < 256; away *= 2)
    EXPECT_GT(at(map, row, middle + away / 2)[1], at(map, row, middle + away)[1]) << away;
  const Vec3d around = at(map, row, middle), opposite = at(map, row, 0);
  EXPECT_GT(around[1], 5 * opposite[1]);
  EXPECT_GT(opposite[2], 1.3 * opposite[0]);
  EXPECT_LT(around[2] / around[0], opposite[2] / opposite[0]);
}

TEST(PhysicalSky, OfPureAirIsDeepBlueAndWhiteAtItsFoot) {
  const RadianceImage map = *physical_sky(sun_at(60), 1).map;
  const Vec3d zenith = at(map, 0, 0), foot = at(map, row_at(map, 2), 0);
  EXPECT_GT(zenith[2], 4 * zenith[0]);
  EXPECT_LT(foot[2], 2 * foot[0]);
  EXPECT_GT(foot[1], 3 * zenith[1]);
}

TEST(PhysicalSky, OfASunInTheZenithIsRound) {
  const RadianceImage map = *physical_sky(sun_at(90), 3).map;
  for (const int row : {0, 10, 128, 255})
    EXPECT_NEAR(at(map, row, 0)[1], at(map, row, 333)[1], 1e-3 * at(map, row, 0)[1]);
}

// Below five degrees the sun outside of the air is the same: the sky fades as it sets, and is red at its foot.
TEST(PhysicalSky, FadesAsTheSunSets) {
  double before = std::numeric_limits<double>::infinity();
  for (const double degrees : {5.0, 2.0, 0.0, -2.0, -6.0, -12.0, -90.0}) {
    const RadianceImage map = *physical_sky(sun_at(degrees), 2).map;
    for (const float value : map.pixels) ASSERT_TRUE(std::isfinite(value) && value >= 0) << degrees;
    const double light = dot(luminance, above(map));
    if (degrees > -12) {
      EXPECT_GT(light, 0);
    }
    EXPECT_LT(light, before + 1e-12) << degrees;
    before = light;
  }
  EXPECT_EQ(before, 0);
  const RadianceImage map = *physical_sky(sun_at(0), 2).map;
  const Vec3d foot = at(map, row_at(map, 1), map.width / 2), zenith = at(map, 0, 0);
  EXPECT_GT(foot[0] / foot[2], 2 * zenith[0] / zenith[2]);
}

TEST(PhysicalSky, IsAsStrongAsTheLampWhateverItsColour) {
  Lamp red = sun_at(50);
  const RadianceImage white = *physical_sky(red, 3).map;
  red.intensity = {{3 / 0.2126f, 0, 0}};
  const RadianceImage tripled = *physical_sky(red, 3).map;
  for (const size_t i : {size_t(5), size_t(300'001), size_t(1'200'000)})
    EXPECT_NEAR(tripled.pixels[i], 3 * white.pixels[i], 1e-5f * tripled.pixels[i]);
}

Scene scene_with_suns(int suns) {
  Report report;
  Document document = find_builtin_scene("box-small")->make(1);
  for (int i = 0; i < suns; i++) {
    document.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(
        {{"type", "directional"}, {"intensity", 1 + i}});
    const int node = DocumentBuilder(document).add(
        "nodes",
        {{"rotation", {-0.7071068, 0, 0, 0.7071068}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    document.json["scenes"][0]["nodes"].push_back(node);
  }
  return scene_from_document(std::move(document), "box", report).value();
}

TEST(PhysicalSky, IsThatOfTheStrongestSunAndStaysInTheDocument) {
  Scene scene = scene_with_suns(2);
  ASSERT_EQ(scene.lamps.size(), 2u);
  note_sky(scene.document.json, {.radiance = Vec3f::filled(1), .turbidity = {}});
  ASSERT_TRUE(light_by_sky(scene, 4));
  EXPECT_EQ(scene.environment.map->pixels, physical_sky(scene.lamps[1], 4).map->pixels);
  EXPECT_FALSE(noted_sky(scene.document.json).radiance);
  Report report;
  const Scene again = scene_from_document(scene.document, "box", report).value();
  ASSERT_TRUE(again.environment.map);
  EXPECT_EQ(again.environment.map->pixels, scene.environment.map->pixels);
}

TEST(PhysicalSky, NeedsASun) {
  Scene scene = scene_with_suns(0);
  const auto refused = light_by_sky(scene, 3);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("no sun"), std::string::npos);
  note_sky(scene.document.json, {.radiance = {}, .turbidity = 3.0f});
  Report report;
  EXPECT_FALSE(scene_from_document(scene.document, "box", report).value().environment.map);
}

}  // namespace
}  // namespace lightwell
