// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/builtin.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "lightwell/scene/relief_knot.h"
#include "lightwell/scene/scene.h"

namespace lightwell {
namespace {

Scene load(const std::string& name, uint64_t seed = 1) {
  Report report;
  auto scene = load_scene(name, {.seed = seed}, report);
  EXPECT_TRUE(scene) << scene.error().message();
  EXPECT_TRUE(report.warnings.empty()) << report.warnings[0];
  return std::move(*scene);
}

size_t triangles_of(const Scene& scene) {
  size_t count = 0;
  for (const Instance& instance : scene.instances)
    count += scene.primitives[static_cast<size_t>(instance.primitive)].mesh.faces.size();
  return count;
}

/// Each triangle of a scene: its corners and its material.
template <typename Visit>
void for_each_triangle(const Scene& scene, const Visit& visit) {
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
    const auto corner = [&](uint32_t i) { return instance.to_scene.point(primitive.mesh.positions[i]); };
    for (const Face& f : primitive.mesh.faces)
      visit(corner(f[0]), corner(f[1]), corner(f[2]), scene.material_of(primitive));
  }
}

/// The solid angle that a triangle subtends at a point, positive when its front is seen (Van Oosterom and Strackee
/// 1983).
double solid_angle(const Vec3f& eye, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3d u = normalized((a - eye).cast<double>()), v = normalized((b - eye).cast<double>()),
              w = normalized((c - eye).cast<double>());
  return -2 * std::atan2(dot(u, cross(v, w)), 1 + dot(u, v) + dot(v, w) + dot(w, u));
}

TEST(ReliefKnot, IsClosedAndTurnsOutwards) {
  const Mesh knot = relief_knot(200, 24, 1);
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  double volume = 0;
  for (const Face& f : knot.faces) {
    for (size_t i = 0; i < 3; i++) edges[{f[i], f[(i + 1) % 3]}]++;
    volume += dot(knot.positions[f[0]], cross(knot.positions[f[1]], knot.positions[f[2]])) / 6;
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_GT(volume, 0);
  EXPECT_EQ(knot.faces.size(), 2u * 200 * 24);
}

TEST(ReliefKnot, HasTheReliefOfItsSeed) {
  const Mesh one = relief_knot(300, 30, 1), again = relief_knot(300, 30, 1), other = relief_knot(300, 30, 2);
  EXPECT_TRUE(one.positions == again.positions);
  EXPECT_FALSE(one.positions == other.positions);
}

TEST(BuiltinScenes, HaveTheirTrianglesCameraAndLamps) {
  const std::map<std::string, size_t> triangles = {{"box", 1100420}, {"box-small", 20030}, {"furnace", 12}};
  for (const BuiltinScene& builtin : builtin_scenes()) {
    const Scene scene = load(std::string(builtin.name));
    const auto expected = triangles.find(scene.name);
    EXPECT_TRUE(expected == triangles.end() || triangles_of(scene) == expected->second) << triangles_of(scene);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "camera");
    EXPECT_GT(scene.cameras[0].width, 0);
    EXPECT_GT(scene.cameras[0].height, 0);
    bool shines = false;
    for (const Material& material : scene.materials) {
      EXPECT_EQ(material.metallic, 0);
      EXPECT_EQ(material.roughness, 1);
      EXPECT_FALSE(material.double_sided);
      shines |= max_component(material.emission) > 0;
    }
    EXPECT_TRUE(shines);
    // A page shows such a material as the baker takes it only when the file says that it has no gloss.
    for (const Json& material : member(scene.document.json, "materials"))
      EXPECT_EQ(number(extension(material, "KHR_materials_specular"), "specularFactor", 1), 0);
  }
}

// Seen from inside a closed surface whose fronts face in, all triangles together cover the whole sphere, 4 pi. A closed
// object that is seen from outside adds nothing, its fronts and backs cancel out; so this holds for any point in the
// air.
TEST(BuiltinScenes, AreClosedAndFaceTheAir) {
  const std::map<std::string, std::vector<Vec3f>> air = {
      {"box-small", {{{0, 1.9f, 1.95f}}, {{-1.9f, 0.1f, -1.9f}}, {{1.5f, 3.9f, 1}}}},
      {"two-rooms", {{{3.9f, 1.6f, 3.7f}}, {{-2, 1, 2}}, {{0.1f, 1, 2}}}},
      {"furnace", {{{0.4f, 1, 2.2f}}}}};
  for (const auto& [name, points] : air) {
    const Scene scene = load(name);
    for (const Vec3f& point : points) {
      double sum = 0;
      for_each_triangle(scene, [&](const Vec3f& a, const Vec3f& b, const Vec3f& c, const Material&) {
        sum += solid_angle(point, a, b, c);
      });
      // Rounding of twenty thousand terms; a wall turned round or left out would change it by a tenth at least.
      EXPECT_NEAR(sum / (4 * std::numbers::pi), 1, 1e-4) << name;
    }
  }
}

TEST(BuiltinScenes, HaveColouredWallsLeftAndRight) {
  const Scene scene = load("box-small");
  const Box3f bounds = scene.bounds();
  EXPECT_EQ(bounds.lo, (Vec3f{{-2, 0, -2.5f}}));
  EXPECT_EQ(bounds.hi, (Vec3f{{2, 4, 2.5f}}));
  for_each_triangle(scene, [&](const Vec3f& a, const Vec3f& b, const Vec3f& c, const Material& material) {
    const auto all_at = [&](float x) { return a[0] == x && b[0] == x && c[0] == x; };
    EXPECT_EQ(all_at(-2), material.name == "red");
    EXPECT_EQ(all_at(2), material.name == "green");
  });
}

TEST(BuiltinScenes, AreFoundByName) {
  EXPECT_EQ(find_builtin_scene("box")->name, "box");
  EXPECT_EQ(find_builtin_scene("sphere"), nullptr);
}

}  // namespace
}  // namespace lightwell
