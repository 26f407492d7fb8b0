// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "lightwell/bake/light_bake.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

LightField baked(const Scene& scene, int nodes) {
  const auto world = world_of(scene);
  LightBakeOptions options;
  options.nodes = nodes;
  options.estimator.photons = 100000;
  if (const int sky = world->lights().environment_luminaire(); sky >= 0) options.estimator.contained.insert(sky);
  Progress silent;
  LightBakeStatistics statistics;
  auto grids = bake_light(*world, options, silent, statistics);
  LW_ASSERT(grids.has_value());
  return LightField(layers_of(std::move(*grids)));
}

/// The mean irradiance of points spread over the six walls of a room, `off` metres in front of them.
float mean_on_walls(const LightField& field, const Box3f& box, float off) {
  Random random(1, 0);
  float sum = 0;
  const int points = 600;
  for (int i = 0; i < points; i++) {
    const int axis = i % 3;
    Vec3f p = box.lo + box.size() * Vec3f{{random.uniform(), random.uniform(), random.uniform()}}, normal{};
    normal[axis] = i % 2 == 0 ? 1.0f : -1.0f;
    p[axis] = i % 2 == 0 ? box.lo[axis] + off : box.hi[axis] - off;
    sum += mean_of_channels(field.irradiance(p, normal, normal)) / points;
  }
  return sum;
}

// docs/light.md section 5: a bright room of 6 m, in it a closed box of 2.3 m with walls of 25 cm and no light inside.
TEST(Leaks, AreNoneIntoAClosedBox) {
  Scene scene = scene_of(room({{-3, -3, -3}}, {{3, 3, 3}}), lambertian(0.5f, 1));
  const Vec3f half = Vec3f::filled(1.15f), inner = Vec3f::filled(0.9f);
  add(scene, block(-half, half), lambertian(0.5f));
  add(scene, room(-inner, inner), lambertian(0.5f));
  for (const int nodes : {16, 24, 32}) {
    const LightField field = baked(scene, nodes);
    const float outside = field.irradiance({{1.16f, 0, 0}}, {{1, 0, 0}}, {{1, 0, 0}})[0];
    EXPECT_GT(outside, 1);
    for (const float off : {0.0f, 0.1f, 0.35f})
      EXPECT_LT(mean_on_walls(field, {-inner, inner}, off), 1e-3f * outside) << nodes << ' ' << off;
  }
}

const Box3f inside{{{-2, 0, -2}}, {{2, 3, 2}}};

// A closed room without a lamp under a sky of pi: walls without thickness that look inwards, or both ways.
TEST(Leaks, AreNoneThroughSheetsUnderASky) {
  for (const bool double_sided : {false, true}) {
    Scene scene;
    const Mesh all = room(inside.lo, inside.hi);
    for (size_t side = 0; side < 6; side++) {
      Mesh wall = all;
      wall.faces = {all.faces[2 * side], all.faces[2 * side + 1]};
      add(scene, wall, lambertian(0.7f));
      scene.materials.back().double_sided = double_sided;
    }
    scene.environment.radiance = Vec3f::filled(1);
    for (const int nodes : {17, 24}) {
      const LightField field = baked(scene, nodes);
      for (const float off : {0.03f, 0.1f, 0.5f})
        EXPECT_LT(mean_on_walls(field, inside, off), 0.01f) << double_sided << ' ' << nodes << ' ' << off;
    }
  }
}

// A cave in a hill, closed: the sky lights the hill and not the cave.
TEST(Leaks, AreNoneIntoACave) {
  for (const bool double_sided : {false, true}) {
    Scene scene = scene_of(block({{-10, -3, -10}}, {{10, 6, 10}}), lambertian(0.5f));
    add(scene, room(inside.lo, inside.hi), lambertian(0.5f));
    for (Material& material : scene.materials) material.double_sided = double_sided;
    scene.environment.radiance = Vec3f::filled(1);
    const LightField field = baked(scene, 24);
    EXPECT_NEAR(field.irradiance({{0, 6, 0}}, {{0, 1, 0}}, {{0, 1, 0}})[0] / pi, 1, 0.05f);
    for (const float off : {0.0f, 0.1f, 0.5f})
      EXPECT_LT(mean_on_walls(field, inside, off), 0.003f) << double_sided << ' ' << off;
  }
}

}  // namespace
}  // namespace lightwell
