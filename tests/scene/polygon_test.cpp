// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/polygon.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

Vec3f area_normal(const Vec3f& a, const Vec3f& b, const Vec3f& c) { return cross(b - a, c - a) * 0.5f; }

/// The triangles of a plane polygon, each of which must turn as the polygon does, and their area.
float checked_area(const std::vector<Vec3f>& points, const Vec3f& normal) {
  std::vector<Face> triangles;
  triangulate(points, triangles);
  EXPECT_EQ(triangles.size(), points.size() - 2);
  float area = 0;
  for (const Face& t : triangles) {
    const float signed_area = dot(area_normal(points[t[0]], points[t[1]], points[t[2]]), normal);
    EXPECT_GE(signed_area, -1e-6f);
    area += signed_area;
  }
  return area;
}

TEST(Triangulate, LeavesTrianglesAsTheyAre) {
  std::vector<Face> triangles;
  triangulate(std::vector<Vec3f>{{}, {}, {}}, triangles);
  EXPECT_EQ(triangles, (std::vector<Face>{{0, 1, 2}}));
  triangulate(std::vector<Vec3f>{{}, {}}, triangles);
  triangulate({}, triangles);
  EXPECT_EQ(triangles.size(), 1u);
}

TEST(Triangulate, CutsAPolygonWithADentInEveryDirection) {
  // An arrowhead, whose fan from any corner but the dent would reach outside; area 1 by the shoelace formula.
  const std::vector<std::array<float, 2>> arrow = {{0, 0}, {2, 0}, {0.5f, 0.5f}, {0, 2}};
  for (int axis = 0; axis < 3; axis++) {
    for (size_t first = 0; first < arrow.size(); first++) {
      for (const bool turned : {false, true}) {
        std::vector<Vec3f> points;
        for (size_t i = 0; i < arrow.size(); i++) {
          const auto& p = arrow[(turned ? arrow.size() - i + first : i + first) % arrow.size()];
          Vec3f point;
          point[axis] = 3;
          point[(axis + 1) % 3] = p[0];
          point[(axis + 2) % 3] = p[1];
          points.push_back(point);
        }
        Vec3f normal{};
        normal[axis] = turned ? -1.0f : 1.0f;
        EXPECT_NEAR(checked_area(points, normal), 1, 1e-6);
      }
    }
  }
}

TEST(Triangulate, CutsStarsAndCombs) {
  std::vector<Vec3f> comb;
  for (int i = 0; i < 40; i++) comb.push_back({{static_cast<float>(i), i % 2 ? 5.0f : 1.0f, 0}});
  comb.push_back({{39, 0, 0}});
  comb.push_back({{0, 0, 0}});
  // A sawtooth from x = 0 to 39 between the heights 1 and 5, clockwise: mean height 3.
  EXPECT_NEAR(checked_area(comb, {{0, 0, -1}}), 39 * 3, 1e-3);
}

TEST(Triangulate, SurvivesPolygonsWithoutSense) {
  Random random(1, 0);
  for (int i = 0; i < 300; i++) {
    std::vector<Vec3f> points(3 + random.below(40));
    for (Vec3f& p : points)
      p = {{static_cast<float>(random.below(4)), static_cast<float>(random.below(4)),
            static_cast<float>(random.below(2))}};
    std::vector<Face> triangles;
    triangulate(points, triangles);
    ASSERT_EQ(triangles.size(), points.size() - 2);
    for (const Face& t : triangles) {
      for (const uint32_t corner : t) ASSERT_LT(corner, points.size());
    }
  }
}

}  // namespace
}  // namespace lightwell
