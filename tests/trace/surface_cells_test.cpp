// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/surface_cells.h"

#include <gtest/gtest.h>

#include <set>

#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

const Box3f region{{{0, 0, 0}}, {{4, 3, 5}}};

Vec3f any_point(Random& random, float reach) {
  return {{reach * (random.uniform() - 0.5f), reach * (random.uniform() - 0.5f), reach * (random.uniform() - 0.5f)}};
}

// Rounding moves the points that rays find on a wall to either side of it: they are in the same cells all the same,
// also where the wall stands on the faces of the region.
TEST(SurfaceCells, AWallsCellsDoNotDependOnRounding) {
  const SurfaceCells cells(region, 0.25f);
  for (uint64_t i = 0; i < 1000; i++) {
    Random random(1, i);
    const Vec3f along{{4 * random.uniform(), 3 * random.uniform(), 0}};
    for (const float wall : {0.0f, 5.0f}) {
      const Vec3f facing{{0, 0, wall > 0 ? -1.0f : 1.0f}};
      const Vec3f nearer = along + Vec3f{{0, 0, wall - 1e-5f}}, farther = along + Vec3f{{0, 0, wall + 1e-5f}};
      EXPECT_EQ(cells.at(nearer, facing), cells.at(farther, facing));
    }
  }
}

TEST(SurfaceCells, TheTwoSidesOfASheetAreTwoCells) {
  const SurfaceCells cells(region, 0.25f);
  for (uint64_t i = 0; i < 1000; i++) {
    Random random(2, i);
    const Vec3f point = any_point(random, 8), facing = sample_sphere(random);
    EXPECT_NE(cells.at(point, facing), cells.at(point, -facing));
  }
}

// Points of one cell are near each other: by the cube's diagonal and what its facings move it.
TEST(SurfaceCells, HoldWhatIsNear) {
  const float size = 0.25f;
  const SurfaceCells cells(region, size);
  const Vec3f facing{{0, 1, 0}};
  for (uint64_t i = 0; i < 20000; i++) {
    Random random(3, i);
    const Vec3f a = any_point(random, 6), b = a + any_point(random, 2);
    if (cells.at(a, facing) != cells.at(b, facing)) continue;
    EXPECT_LE(length(a - b), 1.01f * std::sqrt(3.0f) * size);
  }
}

// A landscape of 100 km round a room has few cells: each level adds a shell of them.
TEST(SurfaceCells, GrowWithTheDistance) {
  const SurfaceCells cells(region, 0.25f);
  std::set<uint64_t> ground;
  for (int x = -500; x < 500; x++)
    for (int z = -500; z < 500; z++)
      ground.insert(cells.at({{static_cast<float>(x) * 100, 0, static_cast<float>(z) * 100}}, {{0, 1, 0}}));
  EXPECT_LT(ground.size(), 60000u);
  EXPECT_GT(ground.size(), 1000u);
}

TEST(SurfaceCells, ParentsHoldTheirChildren) {
  const SurfaceCells cells(region, 0.25f);
  std::set<uint64_t> children, parents;
  for (uint64_t i = 0; i < 50000; i++) {
    Random random(4, i);
    const Vec3f point = Vec3f{{2, 1.5f, 2.5f}} + any_point(random, 2);
    const uint64_t cell = cells.at(point, {{1, 0, 0}});
    children.insert(cell);
    parents.insert(SurfaceCells::parent(cell));
  }
  // 8^3 cubes or so, and eight times fewer.
  EXPECT_GE(children.size(), 512u);
  EXPECT_LE(children.size(), 729u);
  EXPECT_GE(parents.size(), 64u);
  EXPECT_LE(parents.size(), 125u);
}

TEST(SurfaceCells, LieBesideThoseOneCubeAway) {
  const float size = 0.25f;
  const SurfaceCells cells(region, size);
  for (uint64_t i = 0; i < 2000; i++) {
    Random random(5, i);
    const Vec3f point = Vec3f{{2, 1.5f, 2.5f}} + any_point(random, 1);
    const Vec3i step{{static_cast<int>(random.below(3)) - 1, static_cast<int>(random.below(3)) - 1,
                      static_cast<int>(random.below(3)) - 1}};
    const Vec3f facing{{0, 1, 0}};
    EXPECT_EQ(SurfaceCells::beside(cells.at(point, facing), step), cells.at(point + step.cast<float>() * size, facing));
  }
}

}  // namespace
}  // namespace lightwell
