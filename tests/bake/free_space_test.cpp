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
