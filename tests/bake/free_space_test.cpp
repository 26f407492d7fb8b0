// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/free_space.h"

#include <gtest/gtest.h>

#include "lightwell/trace/sampling.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

FreeSpace survey(const World& world, int threads = 0) {
  Progress silent;
  auto space = FreeSpace::survey(world, {.threads = threads}, silent);
  LW_ASSERT(space.has_value());
  return std::move(*space);
}

/// Whether a ray from `origin` along +x ends at the back of a solid.
bool starts_inside(const World& world, const FreeSpace& space, const Vec3f& origin) {
  Random random(1, 0);
  Hit hit;
  return world.surfaces().intersect({origin, {{1, 0, 0}}}, random, hit) && space.from_inside(hit);
}

Scene lit_room() { return scene_of(room({{-3, -3, -3}}, {{3, 3, 3}}), lambertian(0.5f, 1)); }

void add_double_sided(Scene& scene, const Mesh& mesh) {
  add(scene, mesh, lambertian(0.5f));
  scene.materials.back().double_sided = true;
}

TEST(FreeSpace, KnowsAClosedSceneFromAnOpenOne) {
  const Scene closed = lit_room();
  EXPECT_TRUE(survey(*world_of(closed)).closed());
  Scene open = lit_room();
  open.primitives[0].mesh.faces.resize(10);  // without a wall
  EXPECT_FALSE(survey(*world_of(open)).closed());
}

TEST(FreeSpace, TakesDoubleSidedBlocksForSolidsAndSheetsNot) {
  Scene scene = lit_room();
  add_double_sided(scene, block({{-1, -1, -1}}, {{1, 1, 1}}));
  add_double_sided(scene, quad({{2, -1, -1}}, {{0, 2, 0}}, {{0, 0, 2}}));
  const auto world = world_of(scene);
  const FreeSpace space = survey(*world);
  EXPECT_TRUE(starts_inside(*world, space, {}));
  EXPECT_FALSE(starts_inside(*world, space, {{1.5f, 0, 0}}));
  EXPECT_FALSE(starts_inside(*world, space, {{2.5f, 0, 0}}));
}

/// A ball with relief, of which patches of faces up to a share of its area are cut out.
Mesh ball_with_holes(float missing, uint64_t seed) {
  Mesh mesh = turned(sphere(1, 4));
  Random random(seed, 0);
  const Vec3f stretch{{0.6f + random.uniform(), 0.6f + random.uniform(), 0.6f + random.uniform()}};
  for (Vec3f& p : mesh.positions) p = p * stretch * (1 + 0.15f * std::sin(5 * p[0] + 3 * p[1]) * std::sin(4 * p[2]));
  const size_t wanted = static_cast<size_t>(missing * static_cast<float>(mesh.faces.size()));
  const size_t left = mesh.faces.size() - wanted;
  while (mesh.faces.size() > left) {
    const Vec3f middle = mesh.positions[mesh.faces[random.below(static_cast<uint32_t>(mesh.faces.size()))][0]];
    const float radius = 0.05f + 0.15f * random.uniform();
    for (size_t i = mesh.faces.size(); i-- > 0 && mesh.faces.size() > left;)
      if (length(mesh.positions[mesh.faces[i][0]] - middle) < radius)
        mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return mesh;
}

/// The share of rays from a point that come from the inside of a solid; those that meet nothing do not.
float share_of_insides(const World& world, const FreeSpace& space, const Vec3f& point) {
  Random random(2, 0);
  int inside = 0;
  for (int i = 0; i < 400; i++) {
    Hit hit;
    inside += world.surfaces().intersect({point, sample_sphere(random)}, random, hit) && space.from_inside(hit);
  }
  return static_cast<float>(inside) / 400;
}

// As scans are, up to 3 % of their area missing; with one side or two, in a room or under a sky.
TEST(FreeSpace, KnowsSolidsWithHoles) {
  for (uint64_t seed = 0; seed < 12; seed++) {
    for (const float missing : {0.0f, 0.01f, 0.03f}) {
      Scene scene = seed % 2 == 0 ? lit_room() : Scene{};
      if (seed % 2 == 1) scene.environment.radiance = Vec3f::filled(1);
      add(scene, ball_with_holes(missing, seed), lambertian(0.5f));
      scene.materials.back().double_sided = seed % 4 < 2;
      const auto world = world_of(scene);
      const FreeSpace space = survey(*world);
      // A few of its rays leave by the holes.
      EXPECT_GT(share_of_insides(*world, space, {{0.1f, 0, 0.1f}}), 0.8f) << seed << ' ' << missing;
      EXPECT_LT(share_of_insides(*world, space, {{2.4f, 0, 0}}), 0.02f) << seed << ' ' << missing;
    }
  }
}

// An open vessel encloses a volume, but light is in it.
TEST(FreeSpace, TakesAnOpenVesselForNoSolid) {
  Scene scene = lit_room();
  Mesh vessel = block({{-1, -1, -1}}, {{1, 1, 1}});
  std::erase_if(vessel.faces, [&](const Face& f) {
    return std::all_of(f.begin(), f.end(), [&](uint32_t v) { return vessel.positions[v][1] > 0; });
  });
  ASSERT_EQ(vessel.faces.size(), 10u);
  add_double_sided(scene, vessel);
  const auto world = world_of(scene);
  EXPECT_FALSE(starts_inside(*world, survey(*world), {}));
}

TEST(FreeSpace, IsTheSameForAnyNumberOfThreads) {
  Scene scene = lit_room();
  for (int i = 0; i < 4; i++) {
    const Vec3f corner{{-2, -2 + static_cast<float>(i), -2}};
    add_double_sided(scene, block(corner, corner + Vec3f::filled(0.4f + 0.1f * static_cast<float>(i))));
  }
  const auto world = world_of(scene);
  const FreeSpace one = survey(*world, 1), five = survey(*world, 5);
  for (int i = 0; i < 4; i++) {
    const Vec3f inside{{-1.8f, -1.8f + static_cast<float>(i), -1.8f}};
    EXPECT_TRUE(starts_inside(*world, one, inside)) << i;
    EXPECT_TRUE(starts_inside(*world, five, inside)) << i;
  }
}

TEST(FreeSpace, StopsWhenAsked) {
  struct Impatient : Progress {
    bool cancelled() const override { return true; }
  } impatient;
  const Scene scene = lit_room();
  EXPECT_FALSE(FreeSpace::survey(*world_of(scene), {}, impatient));
}

}  // namespace
}  // namespace lightwell
