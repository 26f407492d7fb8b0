// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/grids_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/nasty_json.h"

namespace lightwell {
namespace {

Json pack_of(const std::vector<GridDescription>& grids) {
  return {{"extensions", {{grids_extension, to_json(grids)}}}};
}

GridDescription any_grid(Random& random) {
  GridDescription grid;
  grid.stream = random.below(65536);
  for (int axis = 0; axis < 3; axis++) {
    grid.shape.lo[axis] = 20 * random.uniform() - 10;
    grid.shape.cell[axis] = 0.01f + random.uniform();
    grid.shape.nodes[axis] = static_cast<int>(2 + random.below(255));
  }
  grid.codec = random.below(256);
  grid.normal_offset = 2 * random.uniform() - 1;
  grid.estimated_error = random.uniform();
  grid.priority = static_cast<int>(random.below(10));
  grid.contains = {random.below(2) == 1, random.below(2) == 1, random.below(2) == 1};
  return grid;
}

void expect_same(const GridDescription& a, const GridDescription& b) {
  EXPECT_EQ(a.stream, b.stream);
  EXPECT_EQ(a.shape.lo, b.shape.lo);
  EXPECT_EQ(a.shape.cell, b.shape.cell);
  EXPECT_EQ(a.shape.nodes, b.shape.nodes);
  EXPECT_EQ(a.codec, b.codec);
  EXPECT_EQ(a.normal_offset, b.normal_offset);
  EXPECT_EQ(a.estimated_error, b.estimated_error);
  EXPECT_EQ(a.priority, b.priority);
  EXPECT_EQ(a.contains, b.contains);
}

TEST(GridsExtension, ReadsWhatItWrites) {
  for (uint64_t i = 0; i < 200; i++) {
    Random random(21, i);
    std::vector<GridDescription> grids(random.below(5));
    for (GridDescription& grid : grids) grid = any_grid(random);
    const auto again = read_grids(Json::parse(pack_of(grids).dump()));
    ASSERT_TRUE(again) << again.error().message();
    ASSERT_EQ(again->size(), grids.size());
    for (size_t k = 0; k < grids.size(); k++) expect_same((*again)[k], grids[k]);
  }
}

// What is read can be written and is read alike, whatever was changed.
TEST(GridsExtension, ReadsAnyJsonAsGridsOrAnError) {
  int refused = 0;
  for (uint64_t i = 0; i < 1000; i++) {
    Random random(22, i);
    Json json = pack_of({any_grid(random), any_grid(random)});
    for (uint32_t changes = 1 + random.below(3); changes > 0; changes--) spoil(json, random);
    const auto grids = read_grids(json);
    if (!grids) {
      refused++;
      EXPECT_TRUE(grids.error().element.starts_with(grids_extension)) << grids.error().message();
      continue;
    }
    const auto again = read_grids(pack_of(*grids));
    ASSERT_TRUE(again) << again.error().message();
    for (size_t k = 0; k < grids->size(); k++) expect_same((*again)[k], (*grids)[k]);
  }
  EXPECT_GT(refused, 300);  // else the changes would not be nasty
}

TEST(GridsExtension, NamesWhatIsWrong) {
  const auto error = [](const Json& json) { return read_grids(json).error().message(); };
  EXPECT_EQ(error(Json()), "LIGHTWELL_light_grids: is missing");
  Random random(23, 0);
  Json json = pack_of({any_grid(random), any_grid(random)});
  Json& grid = json["extensions"]["LIGHTWELL_light_grids"]["grids"][1];
  grid["contains"] = {"indirect", "moonlight"};
  EXPECT_EQ(error(json), "LIGHTWELL_light_grids.grids[1].contains: names an unknown light");
  grid["nodes"][2] = 2.5;
  EXPECT_EQ(error(json), "LIGHTWELL_light_grids.grids[1].nodes: is not three whole numbers");
}

TEST(GridsExtension, ContainsWhatAnyOfTheGridsHolds) {
  GridDescription bounced, sky;
  sky.contains.environment = true;
  EXPECT_EQ(contents_of(std::vector{bounced, sky}), (GridContents{.environment = true}));
  EXPECT_EQ(contents_of(std::vector{bounced}), GridContents{});
}

}  // namespace
}  // namespace lightwell
