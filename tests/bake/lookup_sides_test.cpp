// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/lookup_sides.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

TEST(LookupSides, CornersOfCoarserCellsAreTheSamePlace) {
  EXPECT_EQ(lattice_place(2, {{4, 8, 12}}), lattice_place(0, {{1, 2, 3}}));
  EXPECT_EQ(lattice_place(2, {{2, 4, 6}}), lattice_place(1, {{1, 2, 3}}));
  EXPECT_NE(lattice_place(2, {{1, 2, 3}}), lattice_place(1, {{1, 2, 3}}));
  EXPECT_NE(lattice_place(0, {{1, 2, 3}}), lattice_place(0, {{1, 3, 2}}));
}

/// A floor of 4 m that is a sheet, at y = 0, in a grid of 1 m cells that begins 0.2 m below it.
class FloorLookups : public testing::Test {
 protected:
  LookupSides followed(const Scene& scene, const std::vector<Brick>& bricks = {}) {
    world_ = world_of(scene);
    LookupSides sides(world_->surfaces(), shape_.box, 4000, 3);
    BrickTree tree(shape_.grid.cells());
    for (const Brick& brick : bricks) tree.add(brick);
    sides.follow(shape_.grid, tree, 2);
    return sides;
  }

  struct {
    GridShape grid{.lo = {{0, -0.2f, 0}}, .nodes = {{5, 3, 5}}};
    Box3f box{{{0, -0.2f, 0}}, {{4, 1.7f, 4}}};
  } shape_;
  std::unique_ptr<const World> world_;
};

Mesh floor_of_room() { return quad({{0, 0, 0}}, {{0, 0, 4}}, {{4, 0, 0}}); }

// Of one side or two, in the grid's own nodes as in bricks: the nodes below are those across.
TEST_F(FloorLookups, ReachTheNodesBelowAcrossIt) {
  for (const bool double_sided : {false, true}) {
    Scene scene = scene_of(floor_of_room(), lambertian(0.5f));
    scene.materials[0].double_sided = double_sided;
    const LookupSides sides = followed(scene, {{.level = 1, .at = {}}});
    for (int x = 2; x < 5; x++)
      for (int z = 2; z < 5; z++) {
        EXPECT_TRUE(sides.across(lattice_place(0, {{x, 0, z}}))) << double_sided;
        EXPECT_FALSE(sides.across(lattice_place(0, {{x, 1, z}})));
        EXPECT_FALSE(sides.across(lattice_place(0, {{x, 2, z}}))) << "nothing reaches it";
      }
    EXPECT_TRUE(sides.across(lattice_place(1, {{1, 0, 1}})));
    EXPECT_FALSE(sides.across(lattice_place(1, {{1, 1, 1}})));
  }
}

// A node on the floor is on the side of whoever stands there.
TEST_F(FloorLookups, ReachNodesOnIt) {
  shape_.grid.lo[1] = 0;
  const LookupSides sides = followed(scene_of(floor_of_room(), lambertian(0.5f)));
  for (int x = 0; x < 5; x++) EXPECT_FALSE(sides.across(lattice_place(0, {{x, 0, 2}})));
}

// Nobody stands below a scene's lowest surface, though it have two sides: only what is above it counts. Lookups from
// below, shifted away from it, would outweigh those from above that reach a node far below.
TEST_F(FloorLookups, OfTheGroundAreFromAbove) {
  Scene scene = scene_of(floor_of_room(), lambertian(0.5f));
  scene.materials[0].double_sided = true;
  shape_.grid.lo[1] = -0.9f;
  EXPECT_FALSE(followed(scene).across(lattice_place(0, {{2, 0, 2}}))) << "a floor above something";
  shape_.box.lo[1] = 0;
  EXPECT_TRUE(followed(scene).across(lattice_place(0, {{2, 0, 2}})));
}

// A node knows which way what looks it up faces; one that nothing reaches has no facings.
TEST_F(FloorLookups, TellTheNormalsThatReachANode) {
  const LookupSides sides = followed(scene_of(floor_of_room(), lambertian(0.5f)));
  for (const Facing& facing : sides.facings(lattice_place(0, {{2, 1, 2}}))) {
    EXPECT_EQ(facing.normal, (Vec3f{{0, 1, 0}}));
    EXPECT_GT(facing.weight, 0.25f) << "it is 0.8 cells above the floor, lookups up to a quarter";
  }
  for (const Facing& facing : sides.facings(lattice_place(0, {{2, 2, 2}}))) EXPECT_EQ(facing.weight, 0);
}

TEST_F(FloorLookups, AreNoneWithoutSurfaces) {
  const LookupSides sides = followed(scene_of(quad({{9, 0, 0}}, {{0, 0, 4}}, {{4, 0, 0}}), lambertian(0.5f)));
  EXPECT_FALSE(sides.across(lattice_place(0, {{1, 0, 1}})));
}

}  // namespace
}  // namespace lightwell
