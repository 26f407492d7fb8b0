// SPDX-License-Identifier: Apache-2.0
//
// What other programs are given of a field; tests/e2e reads the files as they do.
#include "lightwell/packing/light_volume.h"

#include <gtest/gtest.h>

#include "tests/light/light_fields.h"

namespace lightwell {
namespace {

constexpr GridShape shape{{{-1, 0, 2}}, {{0.5f, 0.25f, 1}}, {{3, 5, 4}}};

float largest(const Moments& moments) {
  float most = 0;
  for (size_t i = 0; i < 6; i++) most = std::max(most, max_component(moments.m[i]));
  return most;
}

TEST(LightVolume, IsTheGridItselfAtItsOwnNodes) {
  const LightGrid grid = lamp_grid(shape, 1);
  const LightVolume volume = sample_volume(LightField({{grid, {}, 0}}), shape, {});
  ASSERT_EQ(volume.nodes.size(), grid.moments.size());
  for (size_t i = 0; i < volume.nodes.size(); i++)
    for (size_t m = 0; m < 9; m++)
      for (int channel = 0; channel < 3; channel++)
        // S is a difference of a dozen floats that are up to four times as large as the largest E.
        EXPECT_NEAR(volume.nodes[i].m[m][channel], grid.moments[i].m[m][channel], 1e-5f * largest(grid.moments[i]));
}

TEST(LightVolume, AddsTheLightOfAllGrids) {
  const LightGrid lamps = lamp_grid(shape, 1), sky = lamp_grid(shape, 2);
  const GridContents of_sky{.indirect = false, .environment = true};
  const LightVolume volume = sample_volume(LightField({{lamps, {}, 0}, {sky, of_sky, 0}}), shape, {});
  for (size_t i = 0; i < volume.nodes.size(); i++) {
    const Vec3f expected = lamps.moments[i].m[2] + sky.moments[i].m[2];
    EXPECT_LT(length(volume.nodes[i].m[2] - expected), 1e-5f * length(expected));  // roundings of floats
  }
}

TEST(LightVolume, TakesTheLightBesideASolidFromItsFreeSide) {
  LightGrid grid = lamp_grid(shape, 1);
  for (size_t i = 0; i < grid.moments.size(); i++) {
    const bool free = shape.node(i)[0] == 0;
    grid.valid[i] = free;
    grid.moments[i] = uniform_light(Vec3f::filled(free ? 1 : 0));
  }
  const GridShape between{shape.lo + Vec3f{{0.25f, 0, 0}}, shape.cell, {{2, 2, 2}}};
  const LightVolume volume = sample_volume(LightField({{grid, {}, 0}}), between, {});
  // Halfway between a free node and one inside, which weighs 2^-13.
  EXPECT_NEAR(volume.nodes[0].m[0][0], std::numbers::pi_v<float>, 1e-3f);
}

TEST(LightVolume, ReachesHalfACellBeyondItsNodesWhereTheFileHasThem) {
  const LightVolume volume{shape, {{1000, 2000, 3000}}, {}};
  EXPECT_EQ(volume.size(), (Vec3f{{1.5f, 1.25f, 4}}));
  EXPECT_EQ(volume.center(), (Vec3d{{999.5, 2000.5, 3003.5}}));
}

}  // namespace
}  // namespace lightwell
