// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/grids_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/extension_properties.h"

namespace lightwell {
namespace {

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
  grid.estimate = {.surface = random.uniform(), .free = random.uniform()};
  grid.priority = static_cast<int>(random.below(10));
  grid.contains = {random.below(2) == 1, random.below(2) == 1, random.below(2) == 1,
                   random.below(2) == 1 ? "sky" : std::string()};
  return grid;
}

struct Grids {
  using Value = std::vector<GridDescription>;
  static constexpr const char* place = grids_extension;
  static Value any(Random& random) {
    Value grids(1 + random.below(4));
    for (GridDescription& grid : grids) grid = any_grid(random);
    return grids;
  }
  static Json pack_of(const Value& grids) { return {{"extensions", {{grids_extension, to_json(grids)}}}}; }
  static Result<Value> read(const Json& json) { return read_grids(json); }
};

TEST(GridsExtension, ReadsWhatItWrites) { expect_reads_what_it_writes<Grids>(21); }
TEST(GridsExtension, ReadsAnyJsonAsGridsOrAnError) { expect_reads_any_json_or_an_error<Grids>(22); }

TEST(GridsExtension, NamesWhatIsWrong) {
  const auto error = [](const Json& json) { return read_grids(json).error().message(); };
  EXPECT_EQ(error(Json()), "LIGHTWELL_light_grids: is missing");
  Random random(23, 0);
  Json json = Grids::pack_of({any_grid(random), any_grid(random)});
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
