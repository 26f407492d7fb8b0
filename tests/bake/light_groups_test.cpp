// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_groups.h"

#include <gtest/gtest.h>

#include "lightwell/bake/light_bake.h"
#include "lightwell/bake/light_parts.h"
#include "lightwell/light/grid_sum.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

/// A grey room, with a red lamp at one end, a blue one at the other, and a window to a green sky.
Scene three_lights() {
  Mesh walls = room({{0, 0, 0}}, {{6, 3, 3}});
  walls.faces.erase(walls.faces.begin());  // half of a wall
  Scene scene = scene_of(walls, lambertian(0.5f));
  scene.lamps = {point_lamp({{1, 2, 1.5f}}, {{10, 0, 0}}), point_lamp({{5, 2, 1.5f}}, {{0, 0, 20}})};
  scene.document.json["nodes"] = Json::parse(R"([{"name": "Red.001"}, {"name": "Blue.001"}])");
  scene.lamps[0].node = 0;
  scene.lamps[1].node = 1;
  scene.environment.radiance = {{0, 0.5f, 0}};
  return scene;
}

std::vector<BakedGrid> bake(const World& world, int nodes, std::span<const LightGroup> groups,
                            SkyApart sky_apart = SkyApart::never, float target_error = 0.01f) {
  LightBakeOptions options;
  options.sky_apart = sky_apart;
  options.target_error = target_error;
  options.nodes = nodes;
  options.most_bytes = 12'000;
  options.groups = groups;
  options.estimator.photons = 50'000;
  options.estimator.contained = LuminaireSet::all(world.lights().luminaires().size());
  Progress silent;
  LightBakeStatistics statistics;
  auto grids = bake_light(world, options, silent, statistics);
  EXPECT_TRUE(grids.has_value());
  return std::move(*grids);
}

float channel(const LightGrid& grid, int c) {
  float sum = 0;
  for (size_t i = 0; i < grid.moments.size(); i++)
    for (const Vec3f& moment : grid.moments[i].m) sum += std::abs(moment[c]) * node_weight(grid.valid[i]);
  return sum;
}

TEST(LightGroups, AreNamedInTheLuminairesOrder) {
  const Scene scene = three_lights();
  const auto world = world_of(scene);
  const auto groups = group_luminaires(*world, GroupedBy::name);
  ASSERT_TRUE(groups);
  ASSERT_EQ(groups->size(), 3u);
  EXPECT_EQ((*groups)[0].name, "Red");
  EXPECT_EQ((*groups)[1].name, "Blue");
  EXPECT_EQ((*groups)[2].name, "sky");
  EXPECT_EQ(group_of(world->lights().luminaires()[1].id, *world, *groups), "Blue");
  EXPECT_EQ(group_luminaires(*world, GroupedBy::extras)->front().name, "others");
  EXPECT_EQ(group_luminaires(*world, GroupedBy::nothing)->front().luminaires, LuminaireSet::all(3));
}

TEST(LightGroups, MoreThanAPackHoldsAreRefused) {
  Scene scene = three_lights();
  for (int i = 0; i < 16; i++) {
    scene.lamps.push_back(scene.lamps[0]);
    scene.lamps.back().node = i + 2;
    scene.document.json["nodes"].push_back({{"name", "Lamp " + std::string(1, static_cast<char>('a' + i))}});
  }
  const auto world = world_of(scene);
  EXPECT_EQ(group_luminaires(*world, GroupedBy::name).error().message(),
            "--groups: 19 groups of light, a pack holds 16");
}

// What one group sends has its colour alone; grey walls do not change it.
TEST(LightGroups, HoldTheLightOfTheirLuminairesAlone) {
  const Scene scene = three_lights();
  const auto world = world_of(scene);
  const auto groups = group_luminaires(*world, GroupedBy::name);
  const std::vector<BakedGrid> grids = bake(*world, 7, *groups);
  ASSERT_FALSE(grids.empty());
  ASSERT_EQ(grids.size() % 3, 0u);
  for (size_t i = 0; i < grids.size(); i++) {
    EXPECT_EQ(grids[i].contains.group, (*groups)[i % 3].name);
    constexpr std::array<int, 3> colors{0, 2, 1};
    for (int c = 0; c < 3; c++) EXPECT_EQ(channel(grids[i].grid, c) > 0, c == colors[i % 3]) << i << ' ' << c;
  }
}

// Light is additive: over the same nodes, regular or refined, the groups add up to the light of all. Each is gathered
// by rays of its own: 5 % of the mean covers the noise of both at each node, 1.5 % as it is gathered.
TEST(LightGroups, AddUpToTheLightOfAll) {
  const Scene scene = three_lights();
  const auto world = world_of(scene);
  const auto groups = group_luminaires(*world, GroupedBy::name);
  for (const int nodes : {9, 0}) {
    const LightGrid all = bake(*world, nodes, {}).front().grid;
    const std::vector<BakedGrid> grids = bake(*world, nodes, *groups);
    LightGrid sum = grids[0].grid;
    for (size_t i = 1; i < 3; i++) {
      EXPECT_TRUE(std::ranges::equal(grids[i].grid.tree.bricks(), sum.tree.bricks()));
      EXPECT_EQ(grids[i].grid.valid, sum.valid);
      EXPECT_EQ(grids[i].grid.normal_offset, sum.normal_offset);
      add_light(sum, grids[i].grid);
    }
    double difference = 0, mean = 0;
    for (int i = 0; i < 500; i++) {
      Random random(7, static_cast<uint64_t>(i));
      const Vec3f point{{6 * random.uniform(), 3 * random.uniform(), 3 * random.uniform()}};
      const Vec3f normal = sample_sphere(random);
      const Vec3f a = all.irradiance(point, normal), b = sum.irradiance(point, normal);
      for (int c = 0; c < 3; c++) {
        difference += static_cast<double>(std::abs(a[c] - b[c]));
        mean += static_cast<double>(a[c]);
      }
    }
    EXPECT_LT(difference, 0.05 * mean) << nodes;
  }
}

TEST(LightParts, AreWhatIsReflectedAndTheSkyOfItsGroup) {
  const Scene scene = three_lights();
  const auto world = world_of(scene);
  const auto groups = group_luminaires(*world, GroupedBy::name);
  const LuminaireSet all = LuminaireSet::all(3);
  EXPECT_EQ(light_parts(*world, all, {}, false).size(), 1u);
  const std::vector<LightPart> two = light_parts(*world, all, {}, true);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(contents_of(two[0], *world), (GridContents{.indirect = true, .lamps = true}));
  EXPECT_EQ(contents_of(two[1], *world), (GridContents{.indirect = false, .environment = true}));
  const std::vector<LightPart> four = light_parts(*world, all, *groups, true);
  ASSERT_EQ(four.size(), 4u);
  EXPECT_EQ(contents_of(four[2], *world), (GridContents{.indirect = true, .group = "sky"}));
  EXPECT_EQ(contents_of(four[3], *world), (GridContents{.indirect = false, .environment = true, .group = "sky"}));
  EXPECT_EQ(light_parts(*world, {}, {}, true).size(), 1u) << "no grid holds the sky's own light";
}

// In the open the sky's own light on what faces up is pi times its radiance, and nothing of it comes from below; what
// the ground reflects is apart. 256 rays, evenly spread, are within 3 %.
TEST(LightParts, TheSkysOwnLightIsWhatComesStraight) {
  Mesh ground = quad({{0, 0, 0}}, {{10, 0, 0}}, {{0, 0, -10}});
  Scene scene = scene_of(ground, lambertian(0.5f));
  scene.environment.radiance = {{1, 2, 3}};
  const auto world = world_of(scene);
  const std::vector<BakedGrid> grids = bake(*world, 5, {}, SkyApart::always);
  ASSERT_GE(grids.size(), 2u);
  const LightGrid &reflected = grids[0].grid, &sky = grids[1].grid;
  EXPECT_TRUE(grids[0].contains.indirect && !grids[1].contains.indirect);
  const Vec3f middle{{5, 0, -5}}, up{{0, 1, 0}}, down{{0, -1, 0}};
  const Vec3f place = middle + up * 0.5f * sky.shape.cell[1];
  for (int c = 0; c < 3; c++) {
    const float radiance = scene.environment.radiance[c];
    EXPECT_NEAR(sky.irradiance(place, up)[c], pi * radiance, 0.03f * pi * radiance);
    EXPECT_NEAR(reflected.irradiance(place, up)[c], 0, 0.03f * pi * radiance);
    EXPECT_GT(reflected.irradiance(place, down)[c], 0.3f * pi * radiance);
    EXPECT_LT(sky.irradiance(place, down)[c], 0.2f * pi * radiance);
  }
}

// Dark posts on a dark floor: next to all light comes straight from the sky, with edges at the posts' feet that no grid
// of 12,000 bytes holds, and what is reflected is a small part of it. Both grids have the same nodes, each half of the
// bytes.
Scene posts_on_a_floor() {
  Mesh floor = block({{0, -1, 0}}, {{8, 0, 8}});
  for (const float x : {1.0f, 3.0f, 5.0f})
    for (const float z : {2.0f, 4.0f, 6.0f}) append(floor, block({{x, 0, z}}, {{x + 0.4f, 1.5f, z + 0.4f}}));
  Scene scene = scene_of(floor, lambertian(0.1f));
  scene.environment.radiance = Vec3f::filled(1);
  return scene;
}

TEST(LightParts, WithTheSkyApartCellsAreDividedByWhatIsReflected) {
  const Scene scene = posts_on_a_floor();
  const auto world = world_of(scene);
  const std::vector<BakedGrid> together = bake(*world, 0, {}), apart = bake(*world, 0, {}, SkyApart::always);
  ASSERT_EQ(together.size(), 1u);
  ASSERT_EQ(apart.size(), 2u);
  EXPECT_EQ(apart[0].grid.moments.size(), apart[1].grid.moments.size());
  EXPECT_LE(apart[0].grid.tree.bricks().size(), together[0].grid.tree.bricks().size());
  EXPECT_LT(apart[0].estimated_error, 0.6f * together[0].estimated_error);
}

TEST(LightParts, TheSkyIsApartWhereOneGridWouldMissTheTarget) {
  const Scene scene = posts_on_a_floor();
  const auto world = world_of(scene);
  const auto count = [&](int nodes, float target) {
    return bake(*world, nodes, {}, SkyApart::as_needed, target).size();
  };
  EXPECT_EQ(count(0, 0.01f), 2u);
  EXPECT_EQ(count(0, 2.0f), 1u) << "any grid reaches an error of 200 %";
  EXPECT_EQ(count(5, 0.01f), 1u) << "a regular grid has no target";
  Scene dark = posts_on_a_floor();
  dark.environment.radiance = {};
  dark.lamps = {point_lamp({{4, 4, 4}}, {{10, 10, 10}})};
  EXPECT_EQ(bake(*world_of(dark), 0, {}, SkyApart::as_needed).size(), 1u) << "without a sky";
  const Scene lamps = three_lights();
  EXPECT_EQ(bake(*world_of(lamps), 0, {}, SkyApart::as_needed).size(), 1u) << "lamps err, not the sky";
}

TEST(LightGroups, OneGroupChangesNothing) {
  const Scene scene = three_lights();
  const auto world = world_of(scene);
  const auto groups = group_luminaires(*world, GroupedBy::extras);
  const auto one = group_luminaires(*world, GroupedBy::nothing);
  EXPECT_EQ(groups->size(), 2u);
  const std::vector<BakedGrid> alone = bake(*world, 5, {}), grouped = bake(*world, 5, *one);
  ASSERT_EQ(alone.size(), grouped.size());
  for (size_t i = 0; i < alone.size(); i++) {
    EXPECT_EQ(grouped[i].contains.group, "");
    for (size_t node = 0; node < alone[i].grid.moments.size(); node++)
      EXPECT_EQ(alone[i].grid.moments[node].m, grouped[i].grid.moments[node].m);
  }
}

}  // namespace
}  // namespace lightwell
