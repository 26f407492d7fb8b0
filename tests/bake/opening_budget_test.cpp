// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/opening_budget.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

Mesh mesh_of(size_t vertices) {
  Mesh mesh;
  mesh.positions.resize(vertices);
  mesh.normals.resize(vertices);
  return mesh;
}

std::vector<uint32_t> share(const std::vector<Mesh>& meshes, uint64_t budget) {
  std::vector<const Mesh*> pointers;
  for (const Mesh& mesh : meshes) pointers.push_back(&mesh);
  return share_opening(pointers, budget);
}

TEST(ShareOpening, PutsSmallMeshesWholeAndGivesTheRestToTheLargeOne) {
  const std::vector<uint32_t> vertices = share({mesh_of(4), mesh_of(500000), mesh_of(4)}, 36000);
  EXPECT_EQ(vertices[0], 0u);
  EXPECT_EQ(vertices[2], 0u);
  EXPECT_EQ(vertices[1], (36000 - 2 * 4 * 36) / 36);
}

TEST(ShareOpening, SharesEquallyAmongLargeMeshes) {
  for (uint32_t vertices : share({mesh_of(10000), mesh_of(20000), mesh_of(30000), mesh_of(40000)}, 36 * 4000))
    EXPECT_NEAR(vertices, 1000, 1);
}

TEST(ShareOpening, GivesEachOfThousandsOfPartsAShape) {
  for (uint32_t vertices : share(std::vector<Mesh>(5000, mesh_of(200)), 40960)) EXPECT_EQ(vertices, 24u);
  for (uint32_t vertices : share(std::vector<Mesh>(5000, mesh_of(20)), 40960)) EXPECT_EQ(vertices, 0u);
}

TEST(ShareOpening, TakesNothing) { EXPECT_TRUE(share({}, 1000).empty()); }

}  // namespace
}  // namespace lightwell
