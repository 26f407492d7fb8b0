// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/place.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

/// Points of a box of this size round a centre.
std::vector<Vec3d> points_round(const Vec3d& center, double size, size_t count, uint64_t seed) {
  Random random(seed, 0);
  std::vector<Vec3d> points;
  for (size_t i = 0; i < count; i++) {
    Vec3d point = center;
    for (double& x : point.e) x += (static_cast<double>(random.below(1 << 20)) / (1 << 20) - 0.5) * size;
    points.push_back(point);
  }
  return points;
}

TEST(Place, NearTheOriginNothingMoves) {
  for (const double size : {1e-3, 1.0, 1e6})
    for (const double distance : {0.0, 1.0, 20.0})
      EXPECT_EQ(origin_amid(points_round({{distance * size, 0, 0}}, size, 1000, 1)), Vec3d{});
  EXPECT_EQ(origin_amid(std::vector<Vec3d>{}), Vec3d{});
  EXPECT_EQ(origin_amid(std::vector<Vec3d>{{{0, 0, 0}}}), Vec3d{});
}

TEST(Place, FarAwayItIsAmidThePoints) {
  for (const double size : {0.1, 10.0, 5000.0})
    for (const Vec3d& center : {Vec3d{{500000.7, 4649776.3, 100}}, Vec3d{{4e6, 1e5, 4.9e6}}, Vec3d{{-1.3e7, 0, 0}}}) {
      const Vec3d origin = origin_amid(points_round(center, size, 1000, 2));
      EXPECT_LE(length(origin - center), size);
      for (const Vec3d& point : points_round(center, size, 100, 3)) {
        const Vec3f near = (point - origin).cast<float>();
        EXPECT_LE(length(near.cast<double>() + origin - point), 1e-6 * size);  // a float's 24 bits, a double's at 1e7
      }
    }
}

// A marker at the origin does not keep a building from being seen.
TEST(Place, FewStraysDoNotMatter) {
  std::vector<Place> places(100, {{{1e6, 2e6, 0}}, 5, 1000});
  places.push_back({{}, 1, 12});
  EXPECT_LE(length(origin_amid(places) - Vec3d{{1e6, 2e6, 0}}), 10);
  places.back().weight = 20000;
  EXPECT_EQ(origin_amid(places), Vec3d{});
}

TEST(Place, APointAloneIsItsOwnOrigin) { EXPECT_EQ(origin_amid({{{{1e6, 2, 3}}, 0, 1}}), (Vec3d{{1e6, 2, 3}})); }

}  // namespace
}  // namespace lightwell
