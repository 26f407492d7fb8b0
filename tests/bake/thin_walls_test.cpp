// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/thin_walls.h"

#include <gtest/gtest.h>

#include "lightwell/bake/light_bake.h"
#include "lightwell/bake/sheets.h"
#include "lightwell/light/stream.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

/// Two closed rooms, a wall of 20 cm between them: the first one is a furnace, the second one is dark.
Scene two_closed_rooms() {
  Scene scene = scene_of(room({{-4, 0, 0}}, {{0, 3, 4}}), lambertian(0.5f, 1));
  add(scene, room({{0.2f, 0, 0}}, {{4.2f, 3, 4}}), lambertian(0.5f));
  return scene;
}

/// A furnace and a dark room on the two sides of a wall without thickness at x = 0, that is seen from both.
Scene rooms_with_a_sheet_between() {
  Scene scene = scene_of(room({{-4, 0, 0}}, {{4, 3, 4}}), lambertian(0.5f));
  Material sheet = lambertian(0.5f);
  sheet.double_sided = true;
  add(scene, quad({{0, 0, 0}}, {{0, 3, 0}}, {{0, 0, 4}}), sheet);
  add(scene, block({{-2.5f, 0.5f, 1.5f}}, {{-1.5f, 1.5f, 2.5f}}), lambertian(0.5f, 3));
  return scene;
}

FreeSpace surveyed(const World& world) {
  Progress silent;
  return FreeSpace::survey(world, {.most_photons = 100000}, silent).value();
}

/// Along the axes, but for those that look at the sheet: towards it a point in free space is looked up behind it.
std::vector<Vec3f> normals() { return {{{1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}}; }

LightGrid baked(const Scene& scene, int nodes) {
  LightBakeOptions options;
  options.nodes = nodes;
  options.estimator.photons = 100000;
  Progress silent;
  LightBakeStatistics statistics;
  auto grid = bake_light(*world_of(scene), options, silent, statistics);
  LW_ASSERT(grid.has_value());
  return std::move(grid->front().grid);
}

// 16 nodes would stand at 27 cm before the wall and at 8 cm behind it.
TEST(ThinWalls, GetANodeInside) {
  const Scene scene = two_closed_rooms();
  const auto world = world_of(scene);
  const GridShape shape = grid_of_walls(*world, surveyed(*world), world->lights().region(), 16);
  EXPECT_GT(shape.nodes[0], 16);
  EXPECT_LE(shape.nodes[0], 18);
  bool inside = false;
  for (int i = 0; i < shape.nodes[0]; i++) {
    const float x = shape.position({{i, 0, 0}})[0];
    inside = inside || (x > 0 && x < 0.2f);
  }
  EXPECT_TRUE(inside);
  // The other axes have no walls, and the region is the same.
  const GridShape plain = GridShape::over(world->lights().region(), 16);
  EXPECT_EQ(shape.nodes[1], plain.nodes[1]);
  EXPECT_EQ(shape.nodes[2], plain.nodes[2]);
  EXPECT_NEAR(length(shape.hi() - plain.hi()), 0, 1e-5f);
}

TEST(ThinWalls, LeaveOtherGridsAlone) {
  const Scene scene = scene_of(room({{-4, 0, 0}}, {{4.2f, 3, 4}}), lambertian(0.5f, 1));
  const auto world = world_of(scene);
  for (const int nodes : {2, 5, 16, 32})
    EXPECT_EQ(grid_of_walls(*world, surveyed(*world), world->lights().region(), nodes).nodes,
              GridShape::over(world->lights().region(), nodes).nodes);
}

// A pack holds 256 nodes an axis and 2^22 in all; what walls add stays within.
TEST(ThinWalls, StayWithinWhatAPackHolds) {
  const Scene scene = two_closed_rooms();
  const auto world = world_of(scene);
  const FreeSpace space = surveyed(*world);
  for (const int nodes : {200, 240, 256}) {
    const GridShape plain = GridShape::over(world->lights().region(), nodes),
                    shape = grid_of_walls(*world, space, world->lights().region(), nodes);
    for (int axis = 0; axis < 3; axis++) EXPECT_LE(shape.nodes[axis], 256);
    EXPECT_LE(shape.count(), std::max(plain.count(), LightLayout::most_nodes));
  }
}

// Next to the wall, on floor, ceiling and walls of the dark room: nothing of the other room's light, which is pi
// everywhere.
TEST(ThinWalls, DoNotLeak) {
  const LightGrid grid = baked(two_closed_rooms(), 16);
  for (const float near : {0.001f, 0.03f, 0.1f, 0.3f}) {
    for (const Vec3f& normal : {Vec3f{{0, 1, 0}}, Vec3f{{0, -1, 0}}, Vec3f{{0, 0, 1}}, Vec3f{{0, 0, -1}}}) {
      const Vec3f wall{{0, normal[1] < 0 ? 3.0f : 0.0f, normal[2] < 0 ? 4.0f : 0.0f}};
      const Vec3f middle = Vec3f{{0, std::abs(normal[2]) * 1.5f, std::abs(normal[1]) * 2}} + wall;
      // An invalid node's weight of 2^-13, times its share of the lookup against the valid one's: 10 at most.
      EXPECT_LT(grid.irradiance(middle + Vec3f{{0.2f + near, 0, 0}}, normal)[0], pi * 10 * 0x1p-13f) << near;
      // Four photon flights' worth of noise in 100000 photons and some 4000 nodes: 8 %.
      EXPECT_NEAR(grid.irradiance(middle - Vec3f{{near, 0, 0}}, normal)[0] / pi, 1, 0.12f) << near;
    }
    EXPECT_LT(grid.irradiance({{0.2f, 1.5f, 2}}, {{1, 0, 0}})[0], pi * 10 * 0x1p-13f);
  }
}

TEST(Sheets, AreKnownFromTheirOwnNodes) {
  const Scene scene = rooms_with_a_sheet_between();
  const auto world = world_of(scene);
  const FreeSpace space = surveyed(*world);
  const Vec3f cell = Vec3f::filled(0.5f);
  Random random(1, 0);
  const auto on_sheet = [&](const Vec3f& node) { return is_on_sheet(world->surfaces(), space, node, cell, 0, random); };
  for (const float off : {0.0f, -0.09f, 0.09f}) EXPECT_TRUE(on_sheet({{off, 1.3f, 0.7f}})) << off;
  EXPECT_FALSE(on_sheet({{0.11f, 1.3f, 0.7f}}));
  // The outer walls have nothing but the outside behind them, the lamp its inside.
  for (const Vec3f& node : {Vec3f{{-4, 1.3f, 0.7f}}, Vec3f{{3, 0, 2}}, Vec3f{{-2.5f, 1, 2}}, Vec3f{{-2, 1, 2}}})
    EXPECT_FALSE(on_sheet(node));
}

// A wall that is thinner than two fifths of a cell belongs to the node between its sides, of which it shows neither.
TEST(Sheets, AreThinWallsToo) {
  const Scene scene = two_closed_rooms();
  const auto world = world_of(scene);
  const FreeSpace space = surveyed(*world);
  Random random(1, 0);
  EXPECT_TRUE(is_on_sheet(world->surfaces(), space, {{0.1f, 1, 1}}, Vec3f::filled(0.6f), 0, random));
  EXPECT_FALSE(is_on_sheet(world->surfaces(), space, {{0.1f, 1, 1}}, Vec3f::filled(0.4f), 0, random));
}

TEST(Sheets, GetNodesOfTheirOwn) {
  const Scene scene = rooms_with_a_sheet_between();
  const auto world = world_of(scene);
  const FreeSpace space = surveyed(*world);
  for (int nodes = 12; nodes < 40; nodes += 3) {
    const GridShape shape = grid_of_walls(*world, space, world->lights().region(), nodes);
    const float place = shape.place_of({})[0];
    EXPECT_NEAR(place, std::round(place), 1e-3f) << nodes;
  }
}

TEST(Sheets, DoNotLeak) {
  const Scene scene = rooms_with_a_sheet_between();
  for (const int nodes : {16, 24}) {
    const LightGrid grid = baked(scene, nodes);
    const float lit = grid.irradiance({{-0.03f, 1.5f, 2}}, {{-1, 0, 0}})[0];
    EXPECT_GT(lit, 0.5f);
    // At 1 cm the dark nodes' weights are 80 times or more that of the sheet's nodes, which have half of the light.
    for (const float near : {0.01f, 0.03f, 0.1f, 0.3f})
      for (const Vec3f& normal : normals())
        EXPECT_LT(grid.irradiance({{near, 1.5f, 2}}, normal)[0], 0.01f * lit) << nodes << ' ' << near;
  }
}

}  // namespace
}  // namespace lightwell
