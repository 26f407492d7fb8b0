// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/orientation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

TEST(Orientation, PutsUpAboveAndTheFrontAhead) {
  for (int up = 0; up < 6; up++)
    for (int front = 0; front < 6; front++) {
      Orientation orientation{.up = {up / 2, up % 2 == 1}, .front = AxisDirection{front / 2, front % 2 == 1}};
      EXPECT_EQ(orientation.possible(), up / 2 != front / 2);
      if (!orientation.possible()) continue;
      orientation.unit = 0.5f;
      const Transform to = orientation.transform();
      EXPECT_EQ(to.point(orientation.up.vector()), (Vec3d{{0, 0.5, 0}}));
      EXPECT_EQ(to.point(orientation.front->vector()), (Vec3d{{0, 0, 0.5}}));
      EXPECT_EQ(to.determinant(), 0.125) << "nothing is mirrored";
    }
}

TEST(Orientation, TakesTheUsualFronts) {
  EXPECT_TRUE(Orientation().none());
  const Transform of_y_up = Orientation().transform();
  EXPECT_EQ(of_y_up.x, Transform().x);
  EXPECT_EQ(of_y_up.y, Transform().y);
  EXPECT_EQ(of_y_up.z, Transform().z);
  EXPECT_EQ((Orientation{.up = {.axis = 2}, .front = {}}).transform().point(Vec3d{{1, 2, 3}}), (Vec3d{{1, 3, -2}}));
}

TEST(Orientation, TurnsAboutXThenYThenZ) {
  EXPECT_EQ((Orientation{.rotate = {{90, 0, 0}}, .front = {}}).transform().point(Vec3d{{0, 1, 0}}), (Vec3d{{0, 0, 1}}));
  EXPECT_EQ((Orientation{.rotate = {{0, 90, 0}}, .front = {}}).transform().point(Vec3d{{0, 0, 1}}), (Vec3d{{1, 0, 0}}));
  EXPECT_EQ((Orientation{.rotate = {{0, 0, -90}}, .front = {}}).transform().point(Vec3d{{0, 1, 0}}),
            (Vec3d{{1, 0, 0}}));
  EXPECT_EQ((Orientation{.rotate = {{90, 90, 0}}, .front = {}}).transform().point(Vec3d{{0, 1, 0}}),
            (Vec3d{{1, 0, 0}}));
  const Vec3d turned = (Orientation{.rotate = {{0, 0, 30}}, .front = {}}).transform().point(Vec3d{{1, 0, 0}});
  EXPECT_NEAR(turned[0], std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(turned[1], 0.5, 1e-12);
  // The file is turned before its up is looked for: a scan that lies on its back and has z up.
  const Orientation lying{.rotate = {{-90, 0, 0}}, .up = {.axis = 2}, .front = {}};
  EXPECT_EQ(lying.transform().point(Vec3d{{0, 1, 0}}), (Vec3d{{0, -1, 0}}));
}

}  // namespace
}  // namespace lightwell
