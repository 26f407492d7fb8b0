// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/normal_map.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

const Vec3f z{{0, 0, 1}};
/// A face in the plane of x and y, and coordinates in glTF's way: u along x, v against y.
const std::array<Vec3f, 3> corners{Vec3f{{0, 0, 0}}, Vec3f{{2, 0, 0}}, Vec3f{{0, 3, 0}}};
const std::array<Vec2f, 3> upright{Vec2f{{0, 1}}, Vec2f{{1, 1}}, Vec2f{{0, 0}}};

/// The colour that a map has for a direction.
Vec3f texel(const Vec3f& direction) { return (direction + Vec3f::filled(1)) / 2; }

TEST(NormalMap, TurnsTowardsTheTextureAxes) {
  const Vec3f direction = normalized(Vec3f{{0.5f, 0.25f, 1}});
  EXPECT_NEAR(length(mapped_normal(z, corners, upright, texel(z), 1) - z), 0, 1e-6f);
  // Green points up in the picture.
  EXPECT_NEAR(length(mapped_normal(z, corners, upright, texel(direction), 1) - direction), 0, 1e-6f);
  const Vec3f halved = normalized(Vec3f{{0.25f, 0.125f, 1}});
  EXPECT_NEAR(length(mapped_normal(z, corners, upright, texel(direction), 0.5f) - halved), 0, 1e-6f);
}

TEST(NormalMap, FollowsMirroredAndTurnedCoordinates) {
  const Vec3f direction = normalized(Vec3f{{0.5f, 0.25f, 1}});
  std::array<Vec2f, 3> mirrored = upright, turned = upright;
  for (Vec2f& t : mirrored) t[0] = -t[0];
  EXPECT_NEAR(length(mapped_normal(z, corners, mirrored, texel(direction), 1) - direction * Vec3f{{-1, 1, 1}}), 0,
              1e-6f);
  // A quarter turn: u runs along y, and up in the picture is against x.
  for (Vec2f& t : turned) t = {{-t[1], t[0]}};
  const Vec3f expected = normalized(Vec3f{{-0.25f, 0.5f, 1}});
  EXPECT_NEAR(length(mapped_normal(z, corners, turned, texel(direction), 1) - expected), 0, 1e-6f);
}

TEST(NormalMap, IsPerpendicularToAnInterpolatedNormal) {
  const Vec3f normal = normalized(Vec3f{{0.6f, -0.3f, 1}});
  const Vec3f flat = mapped_normal(normal, corners, upright, texel(z), 1);
  EXPECT_NEAR(length(flat - normal), 0, 1e-6f);
  const Vec3f tangent = mapped_normal(normal, corners, upright, texel({{1, 0, 0}}), 1);
  EXPECT_NEAR(dot(tangent, normal), 0, 1e-6f);
  EXPECT_GT(tangent[0], 0);
}

// Whatever the file holds, a unit vector comes out.
TEST(NormalMap, OfAnythingIsADirection) {
  EXPECT_EQ(mapped_normal(z, corners, {}, texel({{1, 0, 0}}), 1), z);  // coordinates without a direction
  EXPECT_EQ(mapped_normal(z, {}, upright, texel({{1, 0, 0}}), 1), z);
  EXPECT_EQ(mapped_normal(z, corners, upright, Vec3f::filled(0.5f), 1), z);
  Random random(1, 0);
  const auto number = [&] { return std::pow(10.0f, 60 * random.uniform() - 30) * (random.below(2) ? 1.0f : -1.0f); };
  for (int i = 0; i < 20000; i++) {
    std::array<Vec3f, 3> face;
    std::array<Vec2f, 3> coordinates;
    for (Vec3f& corner : face) corner = {{number(), number(), number()}};
    for (Vec2f& coordinate : coordinates) coordinate = {{number(), number()}};
    const Vec3f texel{{random.uniform(), random.uniform(), random.uniform()}};
    ASSERT_NEAR(length(mapped_normal(z, face, coordinates, texel, number())), 1, 1e-4f) << i;
  }
}

/// A quad in the plane of x and y with a normal map of one texel that leans along u and up.
Scene mapped_quad(const Transform& to_scene) {
  Material material = lambertian(0.5f);
  material.normal_texture.image = 0;
  Scene scene;
  scene.images = {{1, 1, 3, {191, 159, 238}}};  // (0.5, 0.25, 0.87)
  Mesh mesh = quad({{-1, -1, 0}}, {{2, 0, 0}}, {{0, 2, 0}});
  mesh.texcoords[0] = {{{0, 1}}, {{1, 1}}, {{1, 0}}, {{0, 0}}};
  add(scene, mesh, material, to_scene);
  return scene;
}

Vec3f seen_normal(const Scene& scene, const Ray& ray) {
  const auto trace = traced(scene);
  Random random(1, 0);
  Hit hit;
  EXPECT_TRUE(trace->intersect(ray, random, hit));
  return trace->shading_normal(hit, ray.direction);
}

TEST(NormalMap, OfASceneIsSeenFromBothSidesAndInMirrors) {
  const Ray from_front{{{0.1f, 0.2f, 1}}, {{0, 0, -1}}}, from_back{{{0.1f, 0.2f, -1}}, {{0, 0, 1}}};
  const Vec3f direction = normalized(Vec3f{{0.498f, 0.247f, 0.867f}});
  // 8 bits a channel.
  EXPECT_NEAR(length(seen_normal(mapped_quad({}), from_front) - direction), 0, 0.005f);
  EXPECT_NEAR(length(seen_normal(mapped_quad({}), from_back) + direction), 0, 0.005f);
  const Transform mirror = Transform::scaling({{-1, 1, 1}});
  const Vec3f mirrored = direction * Vec3f{{-1, 1, 1}};
  EXPECT_NEAR(length(seen_normal(mapped_quad(mirror), from_front) - mirrored), 0, 0.005f);
}

}  // namespace
}  // namespace lightwell
