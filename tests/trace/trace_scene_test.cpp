// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/trace_scene.h"

#include <gtest/gtest.h>

#include "lightwell/trace/sampling.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

const Vec3f lo{{-1, 0, -2}}, hi{{1, 3, 2}};

TEST(TraceScene, FindsTheWallsOfARoomFromInside) {
  const Scene scene = scene_of(room(lo, hi), lambertian(0.5f));
  const auto trace = traced(scene);
  Random random(1, 0);
  EXPECT_EQ(trace->bounds().lo, lo);
  EXPECT_EQ(trace->bounds().hi, hi);
  Hit hit;
  ASSERT_TRUE(trace->intersect({{{0, 1, 0}}, {{1, 0, 0}}}, random, hit));
  EXPECT_FLOAT_EQ(hit.distance, 1);
  EXPECT_EQ(hit.normal, (Vec3f{{-1, 0, 0}}));
  EXPECT_TRUE(hit.front);
  ASSERT_TRUE(trace->intersect({{{5, 1, 0}}, {{-1, 0, 0}}}, random, hit));
  EXPECT_FALSE(hit.front);
  EXPECT_EQ(hit.facing_normal(), (Vec3f{{1, 0, 0}}));
}

// No ray from inside a closed mesh may slip through its edges, nor may one that leaves a wall meet that wall again.
TEST(TraceScene, IsWatertight) {
  const Scene scene = scene_of(sphere(2, 4), lambertian(0.5f));
  const auto trace = traced(scene);
  Random random(2, 0);
  Vec3f point{};
  for (int i = 0; i < 200000; i++) {
    Hit hit;
    ASSERT_TRUE(trace->intersect({point, sample_sphere(random)}, random, hit)) << i;
    ASSERT_TRUE(hit.front) << i;
    ASSERT_GT(length(hit.position), 1.9f);
    point = i % 3 ? trace->leave(hit.position, hit.normal) : Vec3f{};
    ASSERT_LT(length(point), 2);
    if (i % 3) {
      Hit next;
      ASSERT_TRUE(trace->intersect({point, sample_cosine_hemisphere(hit.normal, random)}, random, next));
      ASSERT_TRUE(next.instance == hit.instance && next.face != hit.face) << i;
    }
  }
}

// A mirroring or uneven transform must turn no front into a back; a primitive of many faces is placed by Embree (8 *
// 4^8 faces twice are more than a million with a third instance), one of few is copied, and both are hit at the same
// places.
TEST(TraceScene, PlacesInstances) {
  const Transform mirror = Transform::translation({{3, 0, 0}}) * Transform::scaling({{-1, 1, 0.5}});
  for (const int splits : {2, 8}) {
    Scene scene = scene_of(sphere(1, splits), lambertian(0.5f));
    scene.instances.push_back({0, mirror, -1});
    scene.instances.push_back({0, Transform::translation({{0, 9, 0}}), -1});
    const auto trace = traced(scene);
    Random random(3, 0);
    Hit hit;
    ASSERT_TRUE(trace->intersect({{{3, 0, 0}}, {{0, 0, 1}}}, random, hit));
    EXPECT_EQ(hit.instance, 1u);
    EXPECT_TRUE(hit.front);
    EXPECT_NEAR(hit.distance, 0.5f, 1e-5f);
    EXPECT_NEAR(length(hit.position - Vec3f{{3, 0, 0.5f}}), 0, 1e-5f);
    EXPECT_NEAR(hit.normal[2], -1, 0.1f);
    ASSERT_TRUE(trace->intersect({{{0, 0, 0}}, {{0, 0, 1}}}, random, hit));
    EXPECT_EQ(hit.instance, 0u);
    EXPECT_NEAR(hit.distance, 1, 1e-5f);
  }
}

// Farther out areas would overflow.
TEST(TraceScene, RefusesPositionsBeyondAFloatsRange) {
  for (const float far : {1e10f, 1e19f, std::numeric_limits<float>::infinity()}) {
    Scene scene = scene_of(quad({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}), lambertian(0, 1));
    scene.primitives[0].mesh.positions[2][1] = far;
    const auto result = TraceScene::build(scene);
    ASSERT_FALSE(result) << far;
    EXPECT_EQ(result.error().message(), "node -1: its mesh reaches farther than 1e9 m from the origin");
  }
}

TEST(TraceScene, RefusesWhatIsEmpty) {
  Scene scene = scene_of(room(lo, hi), lambertian(0.5f));
  scene.primitives[0].mesh.faces.clear();
  const auto result = TraceScene::build(scene);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message(), "scene: it has no triangles");
}

// Half of the rays pass a surface of alpha 0.5: 1000 of 2000 +- 4.5 standard deviations of 22.
TEST(TraceScene, LetsTheTransparentShareOfLightPass) {
  Material glass = lambertian(0.5f);
  glass.alpha = Material::Alpha::blend;
  glass.base_color[3] = 0.5f;
  const Scene scene = scene_of(quad({{-1, -1, 0}}, {{2, 0, 0}}, {{0, 2, 0}}), glass);
  const auto trace = traced(scene);
  int met = 0, blocked = 0;
  for (uint64_t i = 0; i < 2000; i++) {
    Random random(4, i);
    const Ray ray{{{0.3f, 0.2f, 1}}, {{0, 0, -1}}};
    Hit hit;
    met += trace->intersect(ray, random, hit);
    blocked += trace->transmittance(ray, random) == Vec3f{};
  }
  EXPECT_NEAR(met, 1000, 100);
  EXPECT_NEAR(blocked, 1000, 100);
}

// Four panes one behind the other, each of which stops its own share: by which of them a ray is stopped tells that
// chance is another one at each, for both kinds of rays.
TEST(TraceScene, EachPaneHasAChanceOfItsOwn) {
  const std::vector<float> coverage{0.2f, 0.5f, 0.3f, 0.6f};
  Scene scene;
  std::vector<double> shares;
  double left = 1;
  for (size_t i = 0; i < coverage.size(); i++) {
    Material glass = lambertian(0.5f);
    glass.alpha = Material::Alpha::blend;
    glass.base_color[3] = coverage[i];
    add(scene, quad({{-1, -1, -static_cast<float>(i)}}, {{2, 0, 0}}, {{0, 2, 0}}), glass);
    shares.push_back(left * static_cast<double>(coverage[i]));
    left -= shares.back();
  }
  shares.push_back(left);
  const auto trace = traced(scene);
  std::vector<int> stopped(shares.size());
  int passed = 0;
  const int rays = 50000;
  for (uint64_t i = 0; i < rays; i++) {
    Random random(6, i);
    const Ray ray{{{0.3f, 0.2f, 1}}, {{0, 0, -1}}};
    Hit hit;
    stopped[trace->intersect(ray, random, hit) ? hit.instance : coverage.size()]++;
    passed += trace->transmittance(ray, random) != Vec3f{};
  }
  EXPECT_GT(chi_square(stopped, shares), least_probability);
  EXPECT_GT(chi_square({passed, rays - passed}, {left, 1 - left}), least_probability);
}

Material pane(const Vec3f& color, float transmission = 1) {
  Material material = lambertian(color);
  material.transmission = transmission;
  material.double_sided = true;
  return material;
}

// Each colour passes as far as the pane lets it, by both kinds of rays, and behind two panes of both. By chance some
// 0.3 pass a pane that reflects as well: 20,000 rays leave 1.2 % of it, times the tint; three times that.
TEST(TraceScene, TintsWhatPassesAPane) {
  const Vec3f green{{0.1f, 0.9f, 0.1f}}, red{{0.8f, 0.2f, 0.4f}};
  Scene scene = scene_of(quad({{-1, -1, 0}}, {{2, 0, 0}}, {{0, 2, 0}}), pane(green, 0.8f));
  const auto passed = [&](float far) {
    const auto trace = traced(scene);
    Vec3f met_nothing{}, arrived{};
    const int rays = 20000;
    for (uint64_t i = 0; i < rays; i++) {
      Random random(4, i);
      const Ray ray{{{0.3f, 0.2f, 1}}, {{0, 0, -1}}, far};
      Hit hit;
      if (!trace->intersect(ray, random, hit)) met_nothing += hit.tint / rays;
      arrived += trace->transmittance(ray, random) / rays;
    }
    for (int c = 0; c < 3; c++) EXPECT_NEAR(met_nothing[c], arrived[c], 0.05f);
    return arrived;
  };
  for (int c = 0; c < 3; c++) EXPECT_NEAR(passed(5)[c], 0.8f * green[c], 0.03f);
  EXPECT_NEAR(length(passed(0.5f) - Vec3f::filled(1)), 0, 1e-3f);  // the pane stands behind the end
  add(scene, quad({{-1, -1, -1}}, {{2, 0, 0}}, {{0, 2, 0}}), pane(red));
  for (int c = 0; c < 3; c++) EXPECT_NEAR(passed(5)[c], 0.8f * green[c] * red[c], 0.03f);
  // What stands behind a surface that stops the ray tints nothing.
  add(scene, quad({{-1, -1, -0.5f}}, {{2, 0, 0}}, {{0, 2, 0}}), lambertian(0.5f));
  const auto trace = traced(scene);
  Vec3f tint{};
  int met = 0;
  for (uint64_t i = 0; i < 20000; i++) {
    Random random(5, i);
    Hit hit;
    trace->intersect({{{0.3f, 0.2f, 1}}, {{0, 0, -1}}}, random, hit);
    if (hit.instance != 2) continue;
    tint += hit.tint;
    met++;
  }
  for (int c = 0; c < 3; c++) EXPECT_NEAR(tint[c] / 20000, 0.8f * green[c], 0.03f);
  EXPECT_NEAR(met / 20000.0, 0.8f * mean_of_channels(green), 0.02);
}

// A mask of two texels, bilinear between their centres: met where alpha is at least the cutoff.
TEST(TraceScene, CutsMasksOutByTheirTexture) {
  Material leaf = lambertian(0.5f);
  leaf.alpha = Material::Alpha::mask;
  leaf.base_color_texture.image = 0;
  Scene scene = scene_of(quad({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}), leaf);
  scene.primitives[0].mesh.texcoords[0] = {{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}};
  scene.images = {{2, 1, 4, {255, 255, 255, 0, 255, 255, 255, 255}}};
  scene.materials[0].base_color_texture.wrap_u = TextureLookup::Wrap::clamp;
  const auto trace = traced(scene);
  Random random(5, 0);
  Hit hit;
  EXPECT_FALSE(trace->intersect({{{0.48f, 0.5f, 1}}, {{0, 0, -1}}}, random, hit));
  EXPECT_TRUE(trace->intersect({{{0.52f, 0.5f, 1}}, {{0, 0, -1}}}, random, hit));
}

TEST(TraceScene, InterpolatesShadingNormalsTowardsWhoLooks) {
  Scene scene = scene_of(quad({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}), lambertian(0.5f));
  const auto flat = traced(scene);
  Random random(6, 0);
  Hit hit;
  const Ray from_back{{{0.5f, 0.5f, -1}}, {{0, 0, 1}}};
  ASSERT_TRUE(flat->intersect(from_back, random, hit));
  EXPECT_EQ(flat->shading_normal(hit, from_back.direction), (Vec3f{{0, 0, -1}}));
  const Vec3f leaning = normalized(Vec3f{{1, 0, 1}});
  scene.primitives[0].mesh.normals.assign(4, leaning);
  const auto smooth = traced(scene);
  ASSERT_TRUE(smooth->intersect(from_back, random, hit));
  EXPECT_NEAR(length(smooth->shading_normal(hit, from_back.direction) + leaning), 0, 1e-6f);
}

}  // namespace
}  // namespace lightwell
