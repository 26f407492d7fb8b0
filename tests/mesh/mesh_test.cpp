// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/mesh.h"

#include <gtest/gtest.h>

#include "tests/mesh/shapes.h"

namespace lightwell {
namespace {

TEST(Mesh, BoundsHoldAllPositions) {
  EXPECT_TRUE(Mesh{}.bounds().empty());
  const Box3f box = tetrahedron({{1, 2, 3}}, 2).bounds();
  EXPECT_EQ(box.lo, (Vec3f{{1, 2, 3}}));
  EXPECT_EQ(box.hi, (Vec3f{{3, 4, 5}}));
}

TEST(SmoothNormals, OfASheetAreItsNormal) {
  for (const Vec3f& n : smooth_normals(sheet(5))) EXPECT_EQ(n, (Vec3f{{0, 1, 0}}));
}

TEST(SmoothNormals, AreWeightedByArea) {
  Mesh mesh;
  mesh.positions = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 3}}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};  // areas 1/2 towards +z and 3/2 towards +x
  const Vec3f expected = normalized(Vec3f{{3, 0, 1}});
  EXPECT_LT(length(smooth_normals(mesh)[0] - expected), 1e-6f);
}

TEST(SmoothNormals, SurviveAnyScale) {
  for (const float scale : {1e-30f, 1.0f, 1e30f}) {
    const Mesh ball = seamed_sphere(8, 8);
    const std::vector<Vec3f> normals = smooth_normals(scaled(ball, scale, {}));
    for (size_t v = 9; v + 9 < normals.size(); v++) EXPECT_GT(dot(normals[v], ball.normals[v]), 0.8f);
  }
}

TEST(SmoothNormals, WithoutAreaPointUp) {
  Mesh mesh;
  mesh.positions.resize(3);
  mesh.faces = {{0, 1, 1}};
  for (const Vec3f& n : smooth_normals(mesh)) EXPECT_EQ(n, (Vec3f{{0, 1, 0}}));
}

}  // namespace
}  // namespace lightwell
