// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/surface_cache.h"

#include <gtest/gtest.h>

#include "lightwell/trace/paths.h"
#include "tests/mesh/divided.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

SurfaceCache build(const World& world, const SurfaceCacheOptions& options, std::span<const Vec3f> viewpoints) {
  Progress silent;
  auto cache = SurfaceCache::build(world, viewpoints, options, silent);
  LW_ASSERT(cache.has_value());
  return std::move(*cache);
}

std::vector<Vec3f> viewpoints_in(const Box3f& box, int side) {
  std::vector<Vec3f> all;
  for (int i = 0; i < side * side * side; i++) {
    const Vec3f part = (Vec3i{{i % side, i / side % side, i / side / side}}.cast<float>() + Vec3f::filled(0.5f)) /
                       static_cast<float>(side);
    all.push_back(box.lo + box.size() * part);
  }
  return all;
}

const Box3f box{{{0, 0, 0}}, {{2, 1.5f, 3}}};

// In a closed box of albedo rho whose walls shine with Le the irradiance of each wall is pi Le / (1 - rho). A cell has
// 64 samples of direct light, which scatters by about its own size where the walls are near: 1/8 of it, and the bounces
// average over all cells.
TEST(SurfaceCache, IsTheFurnacesClosedForm) {
  for (const float rho : {0.3f, 0.9f}) {
    const Scene scene = scene_of(room(box.lo, box.hi), lambertian(rho, 2));
    const auto world = world_of(scene);
    const auto views = viewpoints_in(box, 4);
    const SurfaceCache cache = build(*world, {.region = box, .cell = 0.25f, .samples = 64}, views);
    EXPECT_GT(cache.cells(), 100u);
    double mean = 0;
    const int points = 400;
    for (uint64_t i = 0; i < points; i++) {
      Random random(1, i);
      const Vec3f floor = box.lo + box.size() * Vec3f{{random.uniform(), 0, random.uniform()}};
      mean += static_cast<double>(cache.irradiance(floor, {{0, 1, 0}})[1] / (2 * pi / (1 - rho))) / points;
    }
    // 96 cells of floor, each 12 % off at most.
    EXPECT_NEAR(mean, 1, 0.03);
  }
}

// A furnished room with plastic and metal against the path tracer: the mean over the floor. Cells blur light, and lose
// none.
TEST(SurfaceCache, AgreesWithPathTracing) {
  Scene scene = scene_of(room(box.lo, box.hi), lambertian({{0.7f, 0.5f, 0.3f}}));
  Material plastic = lambertian(0.3f);
  plastic.specular = 1;
  plastic.roughness = 0.2f;
  scene.materials[0].specular = 1;  // rough: counted as diffuse
  scene.materials[0].roughness = 0.8f;
  add(scene, block({{0.5f, 0.3f, 1}}, {{0.9f, 0.8f, 1.6f}}), plastic);
  Material metal = lambertian(0.8f);
  metal.metallic = 1;
  metal.roughness = 0.4f;
  add(scene, block({{1.3f, 0.2f, 1}}, {{1.7f, 0.6f, 1.6f}}), metal);
  add(scene, quad({{0.6f, 1.49f, 0.6f}}, {{0.8f, 0, 0}}, {{0, 0, 0.8f}}), lambertian(0, 10));
  scene.lamps = {point_lamp({{1, 1, 2.5f}}, {{1, 2, 3}})};
  const auto world = world_of(scene);
  const SurfaceCache cache = build(*world, {.region = box, .cell = 0.1f, .samples = 64}, viewpoints_in(box, 6));
  const LuminaireSet none;
  Vec3d cached{}, traced{};
  for (uint64_t i = 0; i < 4000; i++) {
    Random random(2, i);
    const Vec3f floor = box.lo + box.size() * Vec3f{{random.uniform(), 0, random.uniform()}};
    cached += cache.irradiance(floor, {{0, 1, 0}}).cast<double>();
    DirectAndIndirect light(none);
    trace_path(*world, Receiver::irradiance(floor, {{0, 1, 0}}), 64, random, light);
    traced += (light.direct + light.indirect).cast<double>();
  }
  // A path scatters by about its own size: 1.6 % of 4000; twice that.
  for (int c = 0; c < 3; c++) EXPECT_NEAR(cached[c] / traced[c], 1, 0.035);
}

TEST(SurfaceCache, IsTheSameForAnyNumberOfThreads) {
  Scene scene = scene_of(room(box.lo, box.hi), lambertian(0.6f));
  add(scene, sphere(0.4f, 3), lambertian(0.6f));
  scene.lamps = {point_lamp({{1, 1, 2.5f}}, {{1, 2, 3}})};
  const auto world = world_of(scene);
  const auto views = viewpoints_in(box, 4);
  const auto irradiances = [&](int threads) {
    const SurfaceCache cache = build(*world, {.region = box, .cell = 0.1f, .threads = threads}, views);
    std::vector<Vec3f> all;
    for (uint64_t i = 0; i < 1000; i++) {
      Random random(3, i);
      all.push_back(
          cache.irradiance(box.lo + box.size() * Vec3f{{random.uniform(), 0, random.uniform()}}, {{0, 1, 0}}));
    }
    return all;
  };
  const std::vector<Vec3f> one = irradiances(1);
  EXPECT_EQ(irradiances(2), one);
  EXPECT_EQ(irradiances(5), one);
}

// Where nothing shines in, nothing is lit: a closed room beside a bright one.
TEST(SurfaceCache, KeepsADarkRoomDark) {
  Scene scene = scene_of(room(box.lo, box.hi), lambertian(0.6f, 1));
  add(scene, room({{2.1f, 0, 0}}, {{4, 1.5f, 3}}), lambertian(0.6f));
  const auto world = world_of(scene);
  const Box3f both{box.lo, {{4, 1.5f, 3}}};
  const SurfaceCache cache = build(*world, {.region = both, .cell = 0.2f}, viewpoints_in(both, 6));
  EXPECT_GT(cache.irradiance({{1, 0, 1}}, {{0, 1, 0}})[0], 1);
  EXPECT_EQ(cache.irradiance({{3, 0, 1}}, {{0, 1, 0}}), Vec3f{});
}

/// A lit room with a block in it, of 4^times as many faces as it needs.
Scene furnished(int times) {
  Scene scene = scene_of(divided(room(box.lo, box.hi), times), lambertian(0.6f));
  add(scene, divided(block({{1.3f, 0, 0.5f}}, {{1.7f, 0.6f, 1.1f}}), times), lambertian(0.6f));
  scene.lamps = {point_lamp({{0.3f, 1.2f, 2.5f}}, {{1, 2, 3}})};
  return scene;
}

/// The same, its walls 16 x 16 tiles each: 1,536 instances of 2,048 faces.
Scene tiled() {
  Scene scene = furnished(3);
  scene.primitives[0].mesh = divided(quad({}, {{1, 0, 0}}, {{0, 1, 0}}), 5);
  scene.instances.erase(scene.instances.begin());
  const Vec3f s = box.size(), x{{s[0], 0, 0}}, y{{0, s[1], 0}}, z{{0, 0, s[2]}};
  constexpr int side = 16;
  for (const auto& [u, v] : {std::pair(z, x), {x, y}, {y, z}, {-x, -z}, {-y, -x}, {-z, -y}}) {
    const Vec3d corner = (dot(u, Vec3f::filled(1)) > 0 ? box.lo : box.hi).cast<double>();
    const Vec3d across = u.cast<double>() / double(side), up = v.cast<double>() / double(side);
    const Vec3d normal = cross(across, up) / length(cross(across, up));
    for (int i = 0; i < side * side; i++)
      scene.instances.push_back(
          {0, {across, up, normal, corner + across * double(i % side) + up * double(i / side)}, -1});
  }
  return scene;
}

// A room of 1,536 triangles, of 64 times as many, and tiled with 3 million: the light is the same, and so are the cells
// but for those that few rays meet, as rounding has it: one in a hundred, none is found. Half as large cells are four
// times as many: detail of the light is what costs memory. A cell takes 144 bytes; by powers of two in its tables it
// may be half of that or twice as much.
TEST(SurfaceCache, TakesMemoryByTheLightsDetailNotByTriangles) {
  const auto cache_of = [](const Scene& scene, float cell) {
    return build(*world_of(scene), {.region = box, .cell = cell}, viewpoints_in(box, 6));
  };
  const SurfaceCache coarse = cache_of(furnished(3), 0.1f);
  const auto cells = static_cast<double>(coarse.cells()), bytes = static_cast<double>(coarse.bytes());
  EXPECT_GT(bytes, cells * (2 * sizeof(Vec3f) + sizeof(uint64_t))) << "less than what it knows";
  EXPECT_LT(bytes, cells * 288);
  for (const Scene& scene : {furnished(6), tiled()}) {
    const SurfaceCache fine = cache_of(scene, 0.1f);
    EXPECT_NEAR(static_cast<double>(fine.cells()) / cells, 1, 0.01);
    EXPECT_NEAR(static_cast<double>(fine.bytes()) / bytes, 1, 0.01);
  }
  const SurfaceCache detailed = cache_of(furnished(3), 0.05f);
  EXPECT_NEAR(static_cast<double>(detailed.cells()) / cells, 4, 0.1);
  EXPECT_GT(static_cast<double>(detailed.bytes()) / bytes, 2);
}

}  // namespace
}  // namespace lightwell
