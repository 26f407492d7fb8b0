// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/bricks.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/light/brick_fields.h"

namespace lightwell {
namespace {

TEST(BrickTree, TakesOnlyBricksThatLieInCoarserOnes) {
  BrickTree tree(Vec3i{{4, 4, 4}});
  EXPECT_FALSE(tree.add({2, {{1, 1, 1}}}));
  EXPECT_TRUE(tree.add({1, {{0, 1, 1}}}));
  EXPECT_FALSE(tree.add({1, {{0, 1, 1}}}));
  EXPECT_FALSE(tree.add({1, {{2, 0, 0}}}));
  EXPECT_FALSE(tree.add({1, {{-1, 0, 0}}}));
  EXPECT_FALSE(tree.add({0, {}}));
  EXPECT_TRUE(tree.add({2, {{1, 2, 3}}}));
  EXPECT_FALSE(tree.add({2, {{2, 2, 3}}}));
  EXPECT_EQ(tree.levels(), 2);
  EXPECT_EQ(tree.finest({{1.5f, 2.5f, 3.5f}}), 1u);
  EXPECT_EQ(tree.finest({{0.5f, 2.5f, 3.5f}}), 0u);
  EXPECT_EQ(tree.finest({{2.5f, 2.5f, 3.5f}}), std::nullopt);
  EXPECT_EQ(tree.finest({{-5, 9, 9}}), 0u) << "places outside are clamped to the grid";
}

TEST(BrickTree, ComesBackFromItsBits) {
  Random random(1, 0);
  for (int i = 0; i < 60; i++) {
    const GridShape shape = divisible_shape(random);
    const BrickTree tree = random_tree(shape, random, static_cast<int>(random.below(80)));
    const std::vector<uint8_t> bytes = tree.write();
    const auto read = BrickTree::read(shape.cells(), bytes, tree.bricks().size());
    ASSERT_TRUE(read);
    EXPECT_TRUE(std::ranges::equal(read->bricks(), tree.bricks()));
    if (!tree.empty()) {
      EXPECT_FALSE(BrickTree::read(shape.cells(), bytes, tree.bricks().size() - 1));
    }
    for (size_t length = 0; length + 4 < bytes.size(); length++)
      BrickTree::read(shape.cells(), Bytes(bytes).first(length), 1000);
  }
}

/// Whether some place right beside a corner of a level's cells, within the grid, has no cells of that level.
bool hangs(const BrickTree& tree, int level, const Vec3i& corner) {
  for (int side = 0; side < 8; side++) {
    Vec3f place;
    for (int a = 0; a < 3; a++)
      place[a] = std::ldexp(static_cast<float>(corner[a]) + ((side >> a & 1) != 0 ? 0.5f : -0.5f), -level);
    if (max(Vec3f{}, min(place, tree.cells().cast<float>())) != place) continue;
    const auto finest = tree.finest(place);
    if (!finest || tree.bricks()[*finest].level < level) return true;
  }
  return false;
}

TEST(BrickNodes, AreEveryFinerPointOnceButForThoseThatHang) {
  for (uint64_t seed = 0; seed < 10; seed++) {
    const LightGrid grid = bricked_grid(seed, 30);
    const BrickNodes nodes(grid.tree);
    std::set<std::array<int, 4>> places;
    for (uint32_t brick = 0; brick < grid.bricks.size(); brick++) {
      const Brick& cube = grid.tree.bricks()[brick];
      for (const int point : finer_points()) {
        if (nodes.at(brick, point) == BrickNodes::none) {
          EXPECT_TRUE(hangs(grid.tree, cube.level, cube.corner(point)));
          continue;
        }
        const Vec3i p = cube.corner(point);
        EXPECT_FALSE(hangs(grid.tree, cube.level, p));
        places.insert({cube.level, p[0], p[1], p[2]});
        const BrickNode& node = nodes.nodes()[nodes.at(brick, point)];
        const Brick& first = grid.tree.bricks()[node.brick];
        EXPECT_LE(node.brick, brick);
        EXPECT_EQ(first.level, cube.level);
        EXPECT_EQ(first.corner(node.point), p);
      }
      EXPECT_GE(nodes.first()[brick + 1] - nodes.first()[brick], 26u) << "what LatticeDecoder::open relies on";
    }
    EXPECT_EQ(places.size(), nodes.nodes().size());
  }
}

// A field that is linear in the position is what trilinear interpolation gives, at any level.
TEST(Bricks, InterpolateALinearFieldExactly) {
  for (uint64_t seed = 0; seed < 20; seed++) {
    Random random(seed, 5);
    const GridShape shape = divisible_shape(random);
    const Vec3f slope = random_colour(random) / (shape.hi() - shape.lo);
    const auto light = [&](const Vec3f& p) { return 1 + dot(slope, p - shape.lo); };
    LightGrid grid = grid_of_field(shape, random_tree(shape, random, 25), [&](const Vec3f& p) {
      return std::pair(uniform_light(Vec3f::filled(light(p))), true);
    });
    grid.normal_offset = 0;
    for (int i = 0; i < 100; i++) {
      const Vec3f p = shape.lo + (shape.hi() - shape.lo) * random_colour(random), n = random_direction(random);
      EXPECT_NEAR(grid.irradiance(p, n)[1], light(p) * std::numbers::pi_v<float>, 1e-4f);
    }
  }
}

TEST(Bricks, LookUpAsFarInFrontOfTheSurfaceAsTheGrid) {
  const GridShape shape{{{0, 0, 0}}, {{1, 1, 1}}, {{5, 5, 5}}};
  BrickTree tree(shape.cells());
  tree.add({1, {{0, 0, 0}}});
  LightGrid grid = grid_of_field(
      shape, tree, [](const Vec3f& p) { return std::pair(uniform_light(Vec3f::filled(1 + p[0])), true); });
  grid.normal_offset = 0.5f;
  const Vec3f n{{1, 0, 0}};
  EXPECT_NEAR(grid.irradiance({{1, 1, 1}}, n)[0] / std::numbers::pi_v<float>, 2.5f, 1e-4f);
  EXPECT_NEAR(grid.irradiance({{3, 1, 1}}, n)[0] / std::numbers::pi_v<float>, 4.5f, 1e-4f);
}

// A step across the border of any two cells changes the light by what a step of its length may, beside a solid too.
TEST(Bricks, GoOverIntoEachOtherWithoutASeam) {
  for (uint64_t seed = 0; seed < 12; seed++) {
    Random random(seed, 9);
    const GridShape shape = divisible_shape(random);
    const Vec3f size = shape.hi() - shape.lo, solid = shape.lo + size * random_colour(random);
    const auto free = [&](const Vec3f& p) { return length((p - solid) / size) > 0.3f; };
    const LightGrid grid = grid_of_field(shape, random_tree(shape, random, 40), [&](const Vec3f& p) {
      const Vec3f share = (p - shape.lo) / size;
      return std::pair(parallel_light({{0, 0.6f, 0.8f}}, Vec3f::filled(1) + share * share), free(p));
    });
    const Vec3f finest = grid.shape.cell * std::ldexp(1.0f, -grid.tree.levels());
    for (int i = 0; i < 500; i++) {
      // Half of a step on either side of a corner's plane, of any level.
      const int axis = static_cast<int>(random.below(3));
      Vec3f p = grid.shape.lo + (grid.shape.hi() - grid.shape.lo) * random_colour(random);
      const float plane = std::round((p[axis] - grid.shape.lo[axis]) / finest[axis]);
      const float step = 1e-3f * finest[axis];
      const auto light = [&](float side) {
        p[axis] = grid.shape.lo[axis] + plane * finest[axis] + side * step / 2;
        return grid.irradiance(p, {}, {{0, 0, 1}});
      };
      if (!free(p)) continue;  // nobody sees what is inside
      const Vec3f before = light(-1), after = light(1), far_before = light(-501), far_after = light(501);
      const float allowed =
          1e-3f * max_component(before) + 0.02f * (length(before - far_before) + length(after - far_after));
      EXPECT_LE(length(before - after), allowed) << seed;
    }
  }
}

// What is invalid inside of a solid does not reach a lookup beside valid nodes.
TEST(Bricks, LeaveInvalidNodesOut) {
  const GridShape shape{{{0, 0, 0}}, {{1, 1, 1}}, {{5, 5, 5}}};
  BrickTree tree(shape.cells());
  tree.add({1, {{0, 0, 0}}});
  const LightGrid grid = grid_of_field(shape, tree, [](const Vec3f& p) {
    return std::pair(uniform_light(Vec3f::filled(p[0] < 1.25f ? 100.0f : 1.0f)), p[0] >= 1.25f);
  });
  for (const float x : {1.26f, 1.3f, 1.4f, 1.5f, 1.9f})
    EXPECT_NEAR(grid.irradiance({{x, 1, 1}}, {}, {{0, 1, 0}})[0] / std::numbers::pi_v<float>, 1, 1e-3f) << x;
}

}  // namespace
}  // namespace lightwell
