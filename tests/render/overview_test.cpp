// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/overview.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

Vec3f eye_of(const Camera& camera) { return camera.to_scene.point(Vec3f{}); }

bool is_within(const Box3f& box, const Vec3f& point) {
  return min(point, box.lo) == box.lo && max(point, box.hi) == box.hi;
}

/// How far the middle of a camera's picture is away; infinite when it shows nothing.
float middle_distance(const TraceScene& scene, const Camera& camera) {
  Random random(0, 0);
  Hit hit;
  const Vec3f ahead = camera.to_scene.vector(Vec3f{{0, 0, -1}});
  return scene.intersect({eye_of(camera), ahead}, random, hit) ? hit.distance : std::numeric_limits<float>::infinity();
}

void expect_all_in_view(const Box3f& box, const Camera& camera) {
  const Transform to_camera = camera.to_scene.inverse();
  for (int i = 0; i < 8; i++) {
    const Vec3f corner{{i & 1 ? box.hi[0] : box.lo[0], i & 2 ? box.hi[1] : box.lo[1], i & 4 ? box.hi[2] : box.lo[2]}};
    const Vec3f seen = to_camera.point(corner);
    const float half = -seen[2] * std::tan(camera.yfov / 2);
    EXPECT_LT(std::abs(seen[0]), half);
    EXPECT_LT(std::abs(seen[1]), half);
  }
}

// The built-in rooms without their cameras. From a good place one sees at least half of the longest way through a room.
TEST(Overview, IsInsideOfRooms) {
  for (const char* name : {"box-small", "two-rooms"}) {
    Report report;
    auto scene = load_scene(name, {}, report);
    ASSERT_TRUE(scene.has_value());
    scene->cameras.clear();
    const auto world = world_of(*scene);
    const Camera camera = overview_camera(*world);
    EXPECT_TRUE(is_within(world->surfaces().bounds(), eye_of(camera))) << name;
    EXPECT_GT(middle_distance(world->surfaces(), camera), 2) << name;
    EXPECT_LT(middle_distance(world->surfaces(), camera), 10) << name;
    EXPECT_EQ(camera.to_scene.z[1], 0) << name;
  }
}

TEST(Overview, IsInsideOfASphereSeenFromInside) {
  const Scene scene = scene_of(sphere(2, 3), lambertian(0.5f));
  const auto world = world_of(scene);
  const Camera camera = overview_camera(*world);
  EXPECT_LT(length(eye_of(camera)), 2);
  // The best view of a sphere looks across it.
  EXPECT_GT(middle_distance(world->surfaces(), camera), 2);
}

// Two equal rooms, one of them dark; and a long dark one beside a short lit one.
TEST(Overview, IsWhereTheLightIs) {
  for (const float end : {6.2f, 8.0f}) {
    for (const float side : {1.0f, -1.0f}) {
      Scene scene = scene_of(room({{-3, 0, 0}}, {{3, 3, 4}}), lambertian(0.5f));
      const float lo = side > 0 ? 3.2f : -3.2f - end, hi = lo + end;
      add(scene, room({{lo, 0, 0}}, {{hi, 3, 4}}), lambertian(0.5f));
      scene.lamps = {point_lamp({{0, 2.5f, 2}}, Vec3f::filled(5))};
      const auto world = world_of(scene);
      EXPECT_LT(std::abs(eye_of(overview_camera(*world))[0]), 3) << end << ' ' << side;
    }
  }
}

// A sheet between a lit and a dark room, whose back the lit one sees.
TEST(Overview, IsBeforeASheetThatShowsItsBack) {
  Scene scene = scene_of(room({{-4, 0, -2}}, {{4, 3, 2}}), lambertian(0.5f));
  add(scene, quad({{0, 0, -2}}, {{0, 3, 0}}, {{0, 0, 4}}), lambertian(0.5f));
  for (Material& material : scene.materials) material.double_sided = true;
  for (const float side : {-1.0f, 1.0f}) {
    scene.lamps = {point_lamp({{2 * side, 2.5f, 0}}, Vec3f::filled(5))};
    const auto world = world_of(scene);
    EXPECT_GT(eye_of(overview_camera(*world))[0] * side, 0);
  }
}

// A scan that is declared to have two sides, in the light of a sky: its inside is dark.
TEST(Overview, IsOutsideOfADoubleSidedScan) {
  Scene scene = scene_of(turned(sphere(1, 3)), lambertian(0.5f));
  scene.materials[0].double_sided = true;
  scene.environment.radiance = Vec3f::filled(1);
  const auto world = world_of(scene);
  EXPECT_GT(length(eye_of(overview_camera(*world))), 1);
}

TEST(Overview, IsOutsideOfSolids) {
  for (const Mesh& mesh : {block({{-3, 0, 2}}, {{5, 2, 4}}), turned(sphere(0.01f, 2))}) {
    const Scene scene = scene_of(mesh, lambertian(0.5f));
    const auto world = world_of(scene);
    const Camera camera = overview_camera(*world);
    expect_all_in_view(world->surfaces().bounds(), camera);
    EXPECT_GT(camera.to_scene.t[2], static_cast<double>(world->surfaces().bounds().hi[2]));
  }
}

// A statue on a large floor, and a room whose front is open, as a Cornell box has it: one looks in from the front.
TEST(Overview, IsOutsideOfOpenScenes) {
  Scene statue = scene_of(quad({{-4, 0, -4}}, {{0, 0, 8}}, {{8, 0, 0}}), lambertian(0.5f));
  add(statue, turned(sphere(1, 2)), lambertian(0.5f), Transform::translation({{0, 1, 0}}));
  Mesh open = room({{0, 0, 0}}, {{2, 2, 2}});
  std::erase_if(open.faces, [&](const Face& f) {
    return std::all_of(f.begin(), f.end(), [&](uint32_t v) { return open.positions[v][2] == 2; });
  });
  ASSERT_EQ(open.faces.size(), 10u);
  const Scene stage = scene_of(open, lambertian(0.5f));
  for (const Scene* scene : std::initializer_list<const Scene*>{&statue, &stage}) {
    const auto world = world_of(*scene);
    const Camera camera = overview_camera(*world);
    expect_all_in_view(world->surfaces().bounds(), camera);
    EXPECT_GT(camera.to_scene.t[2], static_cast<double>(world->surfaces().bounds().hi[2]));
    EXPECT_LT(middle_distance(world->surfaces(), camera), 20);
  }
}

}  // namespace
}  // namespace lightwell
