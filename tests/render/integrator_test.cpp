// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/integrator.h"

#include <gtest/gtest.h>

#include "lightwell/render/camera.h"
#include "tests/trace/scenes.h"
#include "tests/trace/truth.h"

namespace lightwell {
namespace {

Picture take(const TraceScene& scene, const Camera& camera, const RenderOptions& options) {
  Progress silent;
  RenderStatistics statistics;
  auto picture = render(scene, camera, options, silent, statistics);
  LW_ASSERT(picture.has_value());
  LW_ASSERT(statistics.rays > 0);
  return std::move(*picture);
}

RenderOptions small(LightPart part, Integrator integrator = Integrator::path) {
  RenderOptions options;
  options.integrator = integrator;
  options.part = part;
  options.width = 16;
  options.height = 12;
  options.samples = 256;
  return options;
}

double mean(const Picture& picture) {
  double sum = 0;
  for (const float value : picture.pixels) sum += static_cast<double>(value);
  return sum / static_cast<double>(picture.pixels.size());
}

/// A grid of the same light in all directions everywhere.
LightGrid uniform_grid(float irradiance) {
  LightGrid grid;
  grid.shape = {.lo = Vec3f::filled(-10), .cell = Vec3f::filled(20), .nodes = {{2, 2, 2}}};
  Moments moments;
  for (size_t i = 0; i < 6; i++) moments.m[i] = Vec3f::filled(irradiance);
  grid.moments.assign(8, moments);
  grid.valid.assign(8, 1);
  return grid;
}

Camera camera_at(const Vec3d& eye) {
  Camera camera;
  camera.to_scene = Transform::translation(eye);
  return camera;
}

TEST(Camera, LooksAlongItsNegativeZ) {
  Camera camera = camera_at({{1, 2, 3}});
  camera.yfov = pi / 2;
  const Ray middle = camera_ray(camera, 2, 0.5f, 0.5f);
  EXPECT_EQ(middle.origin, (Vec3f{{1, 2, 3}}));
  EXPECT_EQ(middle.direction, (Vec3f{{0, 0, -1}}));
  const Ray corner = camera_ray(camera, 2, 1, 0);  // top right: 45 degrees up, twice as far to the side
  EXPECT_NEAR(length(corner.direction - normalized(Vec3f{{2, 1, -1}})), 0, 1e-6f);
}

// Emitted radiance 1, direct irradiance pi and indirect pi times albedo 0.5 / pi: 1 + 0.5 + 0.5 in every pixel.
TEST(Render, OfTheFurnaceIsTwo) {
  const Scene scene = truth_scene("c_furnace");
  const auto trace = traced(scene);
  const Camera& camera = scene.cameras.at(0);
  // 192 pixels of 256 samples, each of which scatters by less than 1 (its path's number of bounces): 0.5 %, three
  // times.
  EXPECT_NEAR(mean(take(*trace, camera, small(LightPart::total))), 2, 0.015);
  EXPECT_NEAR(mean(take(*trace, camera, small(LightPart::direct))), 0.5, 0.004);
  EXPECT_NEAR(mean(take(*trace, camera, small(LightPart::indirect))), 0.5, 0.015);
  EXPECT_NEAR(mean(take(*trace, camera, small(LightPart::total, Integrator::direct))), 1.5, 0.004);
}

TEST(Render, CountsBouncesBetweenSourceAndSurface) {
  const Scene scene = truth_scene("c_furnace");
  const auto trace = traced(scene);
  RenderOptions options = small(LightPart::indirect);
  options.max_bounces = 0;
  EXPECT_EQ(mean(take(*trace, scene.cameras.at(0), options)), 0);
  options.max_bounces = 1;  // pi * 0.5 arrives
  EXPECT_NEAR(mean(take(*trace, scene.cameras.at(0), options)), 0.25, 0.003);
  options.max_bounces = 2;
  EXPECT_NEAR(mean(take(*trace, scene.cameras.at(0), options)), 0.375, 0.004);
}

TEST(Render, LooksUpTheGrid) {
  const Scene scene = truth_scene("c_furnace");
  const auto trace = traced(scene);
  const LightGrid grid = uniform_grid(pi);
  RenderOptions options = small(LightPart::indirect, Integrator::ivg);
  options.grid = &grid;
  for (const float value : take(*trace, scene.cameras.at(0), options).pixels) EXPECT_NEAR(value, 0.5f, 1e-4f);
  options.part = LightPart::total;
  EXPECT_NEAR(mean(take(*trace, scene.cameras.at(0), options)), 2, 0.004);
  // What the grid contains is not lit again.
  const std::vector<uint8_t> contained(trace->lights().luminaires().size(), 1);
  options.contained = contained;
  EXPECT_NEAR(mean(take(*trace, scene.cameras.at(0), options)), 1.5, 1e-4);
}

TEST(Render, GivesMetalsTheGridsLightOfTheMirroredDirection) {
  LightGrid grid = uniform_grid(0);
  for (Moments& moments : grid.moments) moments.m[0] = Vec3f::filled(2);  // light from +x
  Receiver receiver;
  receiver.normal = receiver.shading_normal = {{0, 1, 0}};
  receiver.out = normalized(Vec3f{{-1, 0.001f, 0}});
  receiver.bsdf = {.metal = Vec3f::filled(0.5f), .metallic = 1};
  EXPECT_NEAR(reflected_from_grid(grid, receiver)[0], 0.5f * 2 / pi, 0.005f);
  receiver.out = -receiver.out;
  EXPECT_LT(reflected_from_grid(grid, receiver)[0], 0.005f);
}

TEST(Render, ShowsTheEnvironmentOnlyInTheTotal) {
  Scene scene = scene_of(quad({{50, 50, 50}}, {{1, 0, 0}}, {{0, 1, 0}}), lambertian(0.5f));
  scene.environment.radiance = {{1, 2, 3}};
  const auto trace = traced(scene);
  EXPECT_NEAR(mean(take(*trace, camera_at({}), small(LightPart::total))), 2, 1e-6);
  EXPECT_EQ(mean(take(*trace, camera_at({}), small(LightPart::direct))), 0);
}

TEST(Render, GivesTheSameBytesForAnyNumberOfThreads) {
  const Scene scene = truth_scene("a_cornell");
  const auto trace = traced(scene);
  RenderOptions options = small(LightPart::total);
  options.samples = 8;
  options.threads = 1;
  const Picture one = take(*trace, scene.cameras.at(0), options);
  options.threads = 3;
  EXPECT_EQ(take(*trace, scene.cameras.at(0), options).pixels, one.pixels);
}

TEST(Render, RefusesWhatItCannotDo) {
  const Scene scene = truth_scene("c_furnace");
  const auto trace = traced(scene);
  Progress silent;
  RenderStatistics statistics;
  RenderOptions options = small(LightPart::total, Integrator::ivg);
  EXPECT_EQ(render(*trace, {}, options, silent, statistics).error().message(),
            "picture: there is no light grid to look up");
  options = small(LightPart::total);
  options.width = 0;
  EXPECT_EQ(render(*trace, {}, options, silent, statistics).error().message(), "picture: its size must be positive");
}

}  // namespace
}  // namespace lightwell
