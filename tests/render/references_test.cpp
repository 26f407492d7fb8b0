// SPDX-License-Identifier: Apache-2.0
//
// Pictures that others have rendered and published: Mitsuba's of a Cornell box and of its floor under a uniform sky
// (../shared/data/README.md).
#include <gtest/gtest.h>

#include <filesystem>

#include "lightwell/render/render.h"
#include "lightwell/scene/camera.h"
#include "tests/render/find_integrator.h"

namespace lightwell {
namespace {

const std::filesystem::path references = std::filesystem::path(LIGHTWELL_SHARED) / "data" / "references";
constexpr int side = 256;

Picture take(const Scene& scene, const Camera& camera, int samples, uint64_t seed) {
  auto world = World::build(scene);
  RenderOptions options;
  options.integrator = &find_integrator("path");
  options.light.max_bounces = 4;  // Mitsuba's depth of 6
  options.width = options.height = side;
  options.samples = samples;
  options.seed = seed;
  Progress silent;
  RenderStatistics statistics;
  return render(**world, camera, options, silent, statistics).value();
}

// Blocks of 32 x 32 pixels. Of those on the lamp, and beside them, nothing is taken: a pixel's filter there decides.
TEST(References, CornellBox) {
  if (!std::filesystem::exists(references)) GTEST_SKIP() << "left out: " << references << " is not here";
  Report report;
  Scene scene = load_scene((references / "cornell-box/cornell-box.glb").string(), {}, report).value();
  // In Mitsuba all surfaces are diffuse; glTF's have gloss unless they say otherwise.
  for (Material& material : scene.materials) material.specular = 0;
  const Picture wanted = read_picture(references / "cornell-box/ref-cbox-d6-4096.pfm").value();
  ASSERT_EQ(wanted.width, side);
  constexpr int samples = 24, block = 32, blocks = side / block;
  const std::array pictures{take(scene, scene.cameras.at(0), samples, 1), take(scene, scene.cameras.at(0), samples, 2)};
  const auto shows_lamp = [&](int x, int y) {
    for (int v = std::max(0, y - 1); v <= std::min(side - 1, y + 1); v++)
      for (int u = std::max(0, x - 1); u <= std::min(side - 1, x + 1); u++)
        if (wanted.pixels[static_cast<size_t>(3 * (v * side + u))] > 2) return true;
    return false;
  };
  std::vector<std::array<double, 3>> sums(
      static_cast<size_t>(3 * blocks * blocks));  // of both pictures, and of the reference
  std::array<std::array<double, 3>, 3> all{};
  for (int y = 0; y < side; y++)
    for (int x = 0; x < side; x++) {
      if (shows_lamp(x, y)) continue;
      for (size_t p = 0; p < 3; p++)
        for (size_t c = 0; c < 3; c++) {
          const Picture& picture = p < 2 ? pictures[p] : wanted;
          const auto value = static_cast<double>(picture.pixels[static_cast<size_t>(3 * (y * side + x)) + c]);
          sums[static_cast<size_t>(3 * (y / block * blocks + x / block)) + c][p] += value;
          all[c][p] += value;
        }
    }
  double squares = 0;
  for (const auto& [a, b, reference] : sums) squares += std::pow((a - b) / 2 / reference, 2);
  const double noise = std::sqrt(squares / static_cast<double>(sums.size()));
  EXPECT_LT(noise, 0.01);
  // Of 192 figures one lies three standard deviations away; blocks are not equally noisy.
  for (const auto& [a, b, reference] : sums) EXPECT_NEAR((a + b) / 2, reference, (0.01 + 4 * noise) * reference);
  for (const auto& [a, b, reference] : all) EXPECT_NEAR((a + b) / 2, reference, 0.01 * reference);
}

// A convex surface under a sky of radiance 1 reflects its reflectance, and so has the picture.
TEST(References, Plane) {
  if (!std::filesystem::exists(references)) GTEST_SKIP() << "left out: " << references << " is not here";
  Report report;
  Scene scene = load_scene((references / "cornell-box/meshes/cbox_floor.obj").string(), {}, report).value();
  const Vec3f reflectance{{0.885809f, 0.698859f, 0.666422f}};
  for (Material& material : scene.materials)
    material.base_color = {{reflectance[0], reflectance[1], reflectance[2], 1}};
  scene.environment.radiance = Vec3f::filled(1);
  Camera camera;
  camera.to_scene = looking_at({{278, 273, -800}}, {{278, 273, 0}});
  camera.yfov = 39.3077f * pi / 180;
  const Picture picture = take(scene, camera, 144, 1);
  int rows = 0;
  for (int y = 0; y < side; y++) {
    const Vec3f first{{picture.pixels[static_cast<size_t>(3 * (y * side + side / 2))],
                       picture.pixels[static_cast<size_t>(3 * (y * side + side / 2)) + 1],
                       picture.pixels[static_cast<size_t>(3 * (y * side + side / 2)) + 2]}};
    if (first[2] > 0.9f) continue;  // the sky, or an edge
    rows++;
    Vec3d sum{};
    for (int x = side / 2 - 20; x < side / 2 + 20; x++)
      for (size_t c = 0; c < 3; c++)
        sum[c] += static_cast<double>(picture.pixels[static_cast<size_t>(3 * (y * side + x)) + c]);
    // 5,760 samples: a third of what 640 were off by, which was up to 1.3 %.
    for (size_t c = 0; c < 3; c++) EXPECT_NEAR(sum[c] / 40, static_cast<double>(reflectance[c]), 0.01) << y;
  }
  EXPECT_GT(rows, 30);
}

}  // namespace
}  // namespace lightwell
