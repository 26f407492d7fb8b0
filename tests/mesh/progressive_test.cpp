// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/progressive.h"

#include <gtest/gtest.h>

#include "tests/mesh/level.h"
#include "tests/mesh/shapes.h"

namespace lightwell {
namespace {

Progress silent;

ProgressiveMesh build(const Mesh& mesh, uint32_t base_vertices) {
  SimplifyOptions options;
  options.base_vertices = base_vertices;
  return build_progressive(mesh, options, silent).value();
}

TEST(ProgressiveMesh, ParentsComeFirstAndInEarlierPasses) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    const ProgressiveMesh progressive = build(mesh, 4);
    uint32_t point = progressive.base_points;
    for (uint32_t v = 0; v < progressive.base_vertices(); v++) EXPECT_EQ(progressive.parent[v], v);
    for (const ProgressiveMesh::Pass& pass : progressive.passes) {
      const uint32_t before = progressive.first_of_point[point];
      for (uint32_t v = before; v < progressive.first_of_point[pass.point_end]; v++)
        ASSERT_LT(progressive.parent[v], before);
      EXPECT_GT(pass.point_end, point);
      point = pass.point_end;
    }
    EXPECT_EQ(progressive.first_of_point[point], progressive.mesh.positions.size());
  }
}

TEST(ProgressiveMesh, VerticesOfAPointShareItsParentPoint) {
  const ProgressiveMesh progressive = build(seamed_sphere(24, 32), 4);
  for (uint32_t point = progressive.base_points; point + 1 < progressive.first_of_point.size(); point++) {
    const uint32_t first = progressive.first_of_point[point];
    for (uint32_t v = first; v < progressive.first_of_point[point + 1]; v++) {
      EXPECT_EQ(progressive.mesh.positions[v], progressive.mesh.positions[first]);
      EXPECT_EQ(progressive.point_of(progressive.parent[v]), progressive.point_of(progressive.parent[first]));
    }
  }
}

TEST(ProgressiveMesh, ErrorsFallFromPassToPass) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    const ProgressiveMesh progressive = build(mesh, 4);
    float error = std::numeric_limits<float>::infinity();
    for (const ProgressiveMesh::Pass& pass : progressive.passes) {
      EXPECT_TRUE(std::isfinite(pass.error));
      EXPECT_LE(pass.error, error);
      error = pass.error;
    }
  }
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const Face& f : mesh.faces) {
    const Vec3d a = mesh.positions[f[0]].cast<double>();
    area += length(cross(mesh.positions[f[1]].cast<double>() - a, mesh.positions[f[2]].cast<double>() - a)) / 2;
  }
  return area;
}

// A flat sheet needs nothing but the corners of its outline and of its hole: area and outline stay while 12 vertices
// do.
TEST(ProgressiveMesh, FlatSheetKeepsItsAreaAndCostsNothing) {
  const ProgressiveMesh progressive = build(sheet(24), 32);
  EXPECT_LE(progressive.base_vertices(), 32u);
  const double whole = area_of(dequantize(progressive.mesh));
  EXPECT_NEAR(area_of(level_of(progressive, progressive.base_vertices())), whole, 1e-6 * whole);
  EXPECT_LT(progressive.passes[0].error, 1e-3f);
}

// The sagitta of a spherical cap of area 4 pi / n is 2 / n: so far a ball of n even cells is off; four times that for
// cells that are not even.
TEST(ProgressiveMesh, SphereStaysRound) {
  const ProgressiveMesh progressive = build(seamed_sphere(48, 64), 300);
  const Mesh base = level_of(progressive, progressive.base_vertices());
  for (const Face& f : base.faces) {
    const Vec3f middle = (base.positions[f[0]] + base.positions[f[1]] + base.positions[f[2]]) / 3.0f;
    EXPECT_GT(length(middle), 1 - 4 * 2.0f / static_cast<float>(progressive.base_points));
  }
  EXPECT_NEAR(area_of(base), 4 * 3.14159, 0.05 * 4 * 3.14159);
}

// The seam is a line on the sphere: its texcoords stay on it, and no face reaches across the texture.
TEST(ProgressiveMesh, TextureDoesNotSmearAcrossTheSeam) {
  const ProgressiveMesh progressive = build(seamed_sphere(48, 64), 150);
  const Mesh base = level_of(progressive, progressive.base_vertices());
  for (const Face& f : base.faces)
    for (size_t k = 0; k < 3; k++) {
      const Vec3f &p = base.positions[f[k]], &q = base.positions[f[(k + 1) % 3]];
      if (std::abs(p[1]) > 0.9f || std::abs(q[1]) > 0.9f) continue;  // the poles are torn from the start
      EXPECT_LT(std::abs(base.texcoords[0][f[k]][0] - base.texcoords[0][f[(k + 1) % 3]][0]), 0.5f);
    }
}

TEST(ProgressiveMesh, SmallPiecesVanishBeforeTheLargeOneSuffers) {
  Mesh mesh = knot(100, 20);
  mesh.normals.clear();
  append(mesh, scaled(scattered(500, 3), 0.05f, {}));
  const ProgressiveMesh progressive = build(mesh, 400);
  EXPECT_LE(progressive.base_vertices(), 400u);
  const double knot_area = area_of(knot(100, 20));
  EXPECT_NEAR(area_of(level_of(progressive, progressive.base_vertices())), knot_area, 0.1 * knot_area);
}

// An order that was taken further and undone is the one that ended there.
TEST(SimplifiedMesh, AnyLevelCanBeTheCoarsest) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    const SimplifiedMesh simplified = simplify(mesh, {{}, 4}, silent).value();
    const std::vector<SimplifiedMesh::Level> levels = simplified.levels();
    for (size_t rounds = 0; rounds < levels.size(); rounds++) {
      const ProgressiveMesh progressive = refine_after(simplified, rounds);
      EXPECT_EQ(progressive.base_vertices(), levels[rounds].vertices);
      EXPECT_EQ(progressive.base_faces, levels[rounds].faces);
      EXPECT_EQ(progressive.passes.size(), rounds);
      EXPECT_EQ(rounds == 0 ? 0 : progressive.passes[0].error, levels[rounds].error);
      const ProgressiveMesh direct = build(mesh, levels[rounds].vertices);
      EXPECT_EQ(progressive.parent, direct.parent);
      EXPECT_EQ(progressive.appears_with, direct.appears_with);
      EXPECT_EQ(progressive.mesh.positions, direct.mesh.positions);
      EXPECT_EQ(progressive.mesh.faces, direct.mesh.faces);
    }
  }
}

TEST(ProgressiveMesh, CanBeCancelled) {
  struct Cancelled : Progress {
    bool cancelled() const override { return true; }
  } progress;
  EXPECT_FALSE(build_progressive(knot(40, 9), {}, progress));
}

}  // namespace
}  // namespace lightwell
