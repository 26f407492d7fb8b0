// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/exposure.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/trace/scenes.h"
#include "tests/trace/truth.h"

namespace lightwell {
namespace {

/// A grid from -10 to 10 m of light that comes equally from everywhere: its irradiance as a function of x.
template <typename Irradiance>
LightField grid_of(Irradiance irradiance) {
  LightGrid grid;
  grid.shape = {.lo = Vec3f::filled(-10), .cell = {{0.25f, 20, 20}}, .nodes = {{81, 2, 2}}};
  for (size_t node = 0; node < grid.shape.count(); node++) {
    const float x = grid.shape.position(grid.shape.node(node))[0];
    Moments& moments = grid.moments.emplace_back();
    for (size_t i = 0; i < 6; i++) moments.m[i] = Vec3f::filled(irradiance(x));
  }
  grid.valid.assign(grid.shape.count(), 1);
  return LightField({{std::move(grid), {}, 0}});
}

/// What a wall in front of a camera at the origin is exposed for.
float exposure_of_wall(float albedo, const LightField& grid) {
  const Scene scene = scene_of(quad({{-10, -10, -9}}, {{20, 0, 0}}, {{0, 20, 0}}), lambertian(albedo));
  return choose_exposure(*world_of(scene), {}, grid, {});
}

// The furnace's light is a radiance of 2 from everywhere, and a white wall would have as much: one half takes -2 EV.
TEST(Exposure, ShowsAWhiteSurfaceAtOneHalf) {
  const Scene scene = truth_scene("c_furnace");
  const auto world = world_of(scene);
  const LightField grid = grid_of([](float) { return pi; });
  EXPECT_NEAR(choose_exposure(*world, scene.cameras.at(0), grid, {}), -2, 0.11f);  // rounded to tenths, and noise
  const LuminaireSet contained = LuminaireSet::all(world->lights().luminaires().size());
  EXPECT_NEAR(choose_exposure(*world, scene.cameras.at(0), grid, contained), -1, 1e-5f);
  EXPECT_EQ(choose_exposure(*world, scene.cameras.at(0), grid_of([](float) { return 0.0f; }), contained), 0);
}

TEST(Exposure, KeepsWhiteWhiteAndBlackBlack) {
  const LightField grid = grid_of([](float) { return 2 * pi; });
  EXPECT_NEAR(exposure_of_wall(0.8f, grid), -2, 1e-5f);
  EXPECT_NEAR(exposure_of_wall(0.04f, grid), -2, 1e-5f);
}

// A place so far away that its light is no number is not metered.
TEST(Exposure, IsANumberWhateverTheLightIs) {
  EXPECT_EQ(exposure_of_wall(0.8f, grid_of([](float) { return std::numeric_limits<float>::quiet_NaN(); })), 0);
  EXPECT_EQ(exposure_of_wall(0.8f, grid_of([](float) { return std::numeric_limits<float>::infinity(); })), 0);
}

TEST(Exposure, IsANumberForTheFaintestLight) {
  EXPECT_TRUE(std::isfinite(exposure_of_wall(0.8f, grid_of([](float) { return 1e-41f; }))));
}

// Where half of the wall gets a thousand times the light, one half for the geometric mean would be 0.5 * sqrt(1000) for
// the bright side. Its 0.8 * 1000 is kept at 1.5 instead.
TEST(Exposure, KeepsTheBrightParts) {
  const LightField grid = grid_of([](float x) { return x < 0 ? pi : 1000 * pi; });
  EXPECT_NEAR(exposure_of_wall(0.8f, grid), std::log2(1.5f / 800), 0.051f);
  // A sliver of them does not matter: 3 % of the picture.
  const LightField sliver = grid_of([](float x) { return x < 4.9f ? pi : 1000 * pi; });
  EXPECT_NEAR(exposure_of_wall(0.8f, sliver), -1, 0.41f);
}

}  // namespace
}  // namespace lightwell
