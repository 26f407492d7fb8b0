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

TEST(BrickNodes, AreEveryFinerPointOnce) {
  for (uint64_t seed = 0; seed < 10; seed++) {
    const LightGrid grid = bricked_grid(seed, 30);
    const BrickNodes nodes(grid.tree);
    std::set<std::array<int, 4>> places;
    for (uint32_t brick = 0; brick < grid.bricks.size(); brick++) {
      const Brick& cube = grid.tree.bricks()[brick];
      for (const int point : finer_points()) {
        const Vec3i p = cube.at * Brick::cells + Brick::local(point);
        places.insert({cube.level, p[0], p[1], p[2]});
        const BrickNode& node = nodes.nodes()[nodes.at(brick, point)];
        const Brick& first = grid.tree.bricks()[node.brick];
        EXPECT_LE(node.brick, brick);
        EXPECT_EQ(first.level, cube.level);
        EXPECT_EQ(first.at * Brick::cells + Brick::local(node.point), p);
      }
      EXPECT_GE(nodes.first()[brick + 1] - nodes.first()[brick], 27u) << "what LatticeDecoder::open relies on";
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

TEST(Bricks, LookUpInFrontOfTheSurfaceByTheirOwnCells) {
  const GridShape shape{{{0, 0, 0}}, {{1, 1, 1}}, {{5, 5, 5}}};
  BrickTree tree(shape.cells());
  tree.add({1, {{0, 0, 0}}});
  LightGrid grid = grid_of_field(
      shape, tree, [](const Vec3f& p) { return std::pair(uniform_light(Vec3f::filled(1 + p[0])), true); });
  grid.normal_offset = 0.5f;
  const Vec3f n{{1, 0, 0}};
  EXPECT_NEAR(grid.irradiance({{1, 1, 1}}, n)[0] / std::numbers::pi_v<float>, 2.25f, 1e-4f);
  EXPECT_NEAR(grid.irradiance({{3, 1, 1}}, n)[0] / std::numbers::pi_v<float>, 4.5f, 1e-4f);
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
