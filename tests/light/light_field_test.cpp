// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/light_field.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

const Vec3f up{{0, 1, 0}};

/// A grid of the same light in all directions everywhere in a cube round the origin.
LightGrid cube(float half, float irradiance) {
  LightGrid grid;
  grid.shape = {.lo = Vec3f::filled(-half), .cell = Vec3f::filled(2 * half), .nodes = {{2, 2, 2}}};
  Moments moments;
  for (size_t i = 0; i < 6; i++) moments.m[i] = Vec3f::filled(irradiance);
  grid.moments.assign(8, moments);
  grid.valid.assign(8, 1);
  return grid;
}

float at(const LightField& field, float x) { return field.irradiance({{x, 0, 0}}, up, up)[0]; }

TEST(LightField, OfOneGridIsThatGridEverywhere) {
  const LightField field({{cube(1, 3), {}, 0}});
  EXPECT_FLOAT_EQ(at(field, 0), 3);
  EXPECT_FLOAT_EQ(at(field, 50), 3);
}

TEST(LightField, ThatIsEmptyIsDark) {
  EXPECT_TRUE(LightField().empty());
  EXPECT_EQ(at(LightField(), 0), 0);
}

// A room's grid before the terrain's, in whatever order they come.
TEST(LightField, AsksTheGridOfTheHighestPriorityThatHoldsThePoint) {
  for (const bool turned : {false, true}) {
    std::vector<LightField::Layer> layers{{cube(1, 3), {}, 5}, {cube(10, 7), {}, 0}};
    if (turned) std::swap(layers[0], layers[1]);
    const LightField field(std::move(layers));
    EXPECT_EQ(field.layers().front().priority, 5);
    EXPECT_FLOAT_EQ(at(field, 0.5f), 3);
    EXPECT_FLOAT_EQ(at(field, 1), 3);  // the outermost surfaces lie on the box
    EXPECT_FLOAT_EQ(at(field, 1.5f), 7);
    EXPECT_FLOAT_EQ(at(field, 15), 7);
  }
}

TEST(LightField, AddsUpLightOfDifferentContents) {
  const GridContents sky{.indirect = false, .environment = true};
  const LightField field({{cube(1, 3), {}, 1}, {cube(10, 7), {}, 0}, {cube(10, 100), sky, 0}});
  EXPECT_FLOAT_EQ(at(field, 0), 103);
  EXPECT_FLOAT_EQ(at(field, 5), 107);
}

// The offset is of the surface, the light of the direction.
TEST(LightField, LooksInOneDirectionAtThePlaceOfAnother) {
  LightGrid grid = cube(1, 0);
  for (size_t node = 0; node < 8; node++) {
    if (node & 2) grid.moments[node].m[0] = Vec3f::filled(4);  // from +x, at the upper nodes alone
  }
  grid.normal_offset = 0.25f;
  const LightField field({{std::move(grid), {}, 0}});
  EXPECT_FLOAT_EQ(field.irradiance({}, up, {{1, 0, 0}})[0], 3);
  EXPECT_FLOAT_EQ(field.irradiance({}, -up, {{1, 0, 0}})[0], 1);
  EXPECT_FLOAT_EQ(field.irradiance({}, up, {{-1, 0, 0}})[0], 0);
}

}  // namespace
}  // namespace lightwell
