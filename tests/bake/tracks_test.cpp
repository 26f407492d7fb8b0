// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/tracks.h"

#include <gtest/gtest.h>

#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

GridShape grid(Vec3f lo, Vec3f cell, Vec3i nodes) { return {.lo = lo, .cell = cell, .nodes = nodes}; }

std::vector<Moments> moments(const TrackSums& sums, const GridShape& shape) {
  return sums.moments(1, std::vector<float>(shape.count(), 1.0f));
}

/// The sum over nodes of a moment times the volume of its box: the photon's whole length times the moment of its
/// direction.
Vec3d total(const std::vector<Moments>& all, const GridShape& shape, size_t moment) {
  Vec3d sum{};
  for (size_t node = 0; node < all.size(); node++) {
    const Vec3f size = node_box(shape, node).size();
    sum += (all[node].m[moment] * (size[0] * size[1] * size[2])).cast<double>();
  }
  return sum;
}

TEST(Tracks, DivideAFlightAmongTheBoxesItPasses) {
  const GridShape shape = grid({}, {{2, 1, 1}}, {{3, 2, 2}});
  TrackSums sums(shape);
  // Along +x through the lower half of y and the upper of z: boxes [0, 1], [1, 3], [3, 4] of the nodes (., 0, 1).
  sums.deposit({{0.5f, 0.2f, 0.8f}}, {{1, 0, 0}}, 3, {{1, 2, 4}});
  const std::vector<Moments> all = moments(sums, shape);
  // Light that flies along +x comes from -x: E_{-x} is length / volume, and S is 0 for a direction along an axis.
  EXPECT_NEAR(all[shape.index({{0, 0, 1}})].m[1][0], 0.5f / (1 * 0.5f * 0.5f), 1e-5f);
  EXPECT_NEAR(all[shape.index({{1, 0, 1}})].m[1][1], 2 * 2 / (2 * 0.5f * 0.5f), 1e-5f);
  EXPECT_NEAR(all[shape.index({{2, 0, 1}})].m[1][2], 4 * 0.5f / (1 * 0.5f * 0.5f), 1e-5f);
  EXPECT_EQ(all[shape.index({{1, 0, 1}})].m[0], Vec3f{});
  EXPECT_EQ(all[shape.index({{1, 0, 1}})].m[6], Vec3f{});
  EXPECT_EQ(all[shape.index({{1, 1, 1}})].m[1], Vec3f{});
}

// Nothing of a flight inside the grid is lost, and nothing outside is counted, whatever its direction.
TEST(Tracks, KeepTheLengthInsideTheGrid) {
  const GridShape shape = grid({{-1, 2, 0}}, {{0.3f, 0.5f, 0.2f}}, {{7, 4, 12}});
  const Box3f box{shape.lo, shape.hi()};
  Random random(1, 0);
  for (int i = 0; i < 2000; i++) {
    const Vec3f direction =
        i < 6 ? Vec3f{{i / 2 == 0 ? 1.0f : 0, i / 2 == 1 ? 1.0f : 0, i / 2 == 2 ? 1.0f : 0}} * (i % 2 ? 1.0f : -1.0f)
              : sample_sphere(random);
    const Vec3f inside = box.lo + box.size() * Vec3f{{random.uniform(), random.uniform(), random.uniform()}};
    // To the box's end on both sides, from the slabs.
    float before = 1e9f, after = 1e9f;
    for (int a = 0; a < 3; a++) {
      if (direction[a] == 0) continue;
      const float t0 = (box.lo[a] - inside[a]) / direction[a], t1 = (box.hi[a] - inside[a]) / direction[a];
      before = std::min(before, -std::min(t0, t1));
      after = std::min(after, std::max(t0, t1));
    }
    TrackSums sums(shape);
    sums.deposit(inside - direction * (before + 1), direction, std::numeric_limits<float>::infinity(), {{1, 0.5f, 0}});
    const std::vector<Moments> all = moments(sums, shape);
    Vec3d absolute{};
    for (int a = 0; a < 3; a++) {
      const Vec3d plus = total(all, shape, static_cast<size_t>(2 * a)),
                  minus = total(all, shape, static_cast<size_t>(2 * a + 1));
      absolute[a] = plus[0] + minus[0];
      // Half the weight in green, and all of it on the side that the light comes from.
      EXPECT_NEAR(plus[1] + minus[1], absolute[a] / 2, 1e-4);
      EXPECT_EQ(direction[a] > 0 ? plus[0] : minus[0], 0);
    }
    const double expected = static_cast<double>(before + after);
    // Float positions of the faces are good to 1e-6 of the grid's extent, at up to 22 faces.
    EXPECT_NEAR(length(absolute), expected, 1e-4) << i;
  }
}

TEST(Tracks, AddUpInAnyOrder) {
  const GridShape shape = grid({}, Vec3f::filled(1), {{3, 3, 3}});
  TrackSums forward(shape), backward(shape), half(shape);
  const auto deposit = [&](TrackSums& sums, uint64_t i) {
    Random random(7, i);
    const Vec3f origin{{random.uniform() * 2, random.uniform() * 2, random.uniform() * 2}};
    sums.deposit(origin, sample_sphere(random), 1, {{random.uniform(), random.uniform(), 1}});
  };
  for (uint64_t i = 0; i < 1000; i++) deposit(forward, i);
  for (uint64_t i = 1000; i-- > 0;) deposit(i < 400 ? half : backward, i);
  backward += half;
  const auto a = moments(forward, shape), b = moments(backward, shape);
  for (size_t node = 0; node < a.size(); node++) EXPECT_EQ(a[node].m, b[node].m);
}

TEST(Tracks, TakeHeavyPhotons) {
  const GridShape shape = grid({}, Vec3f::filled(1), {{2, 2, 2}});
  TrackSums sums(shape);
  sums.deposit({{0.1f, 0.1f, 0.1f}}, {{1, 0, 0}}, 0.4f, {{10000, 0, 0}});
  EXPECT_NEAR(moments(sums, shape)[0].m[1][0], 10000 * 0.4f / 0.125f, 0.1f);
}

TEST(Tracks, DivideByTheFreeShare) {
  const GridShape shape = grid({}, Vec3f::filled(1), {{2, 2, 2}});
  TrackSums sums(shape);
  sums.deposit({{0.1f, 0.1f, 0.1f}}, {{1, 0, 0}}, 0.8f, Vec3f::filled(1));
  std::vector<float> shares(8, 0.5f);
  shares[1] = 0;
  const auto halved = sums.moments(1, shares);
  EXPECT_NEAR(halved[0].m[1][0], 2 * moments(sums, shape)[0].m[1][0], 1e-5f);
  EXPECT_EQ(halved[1].m[1], Vec3f{});
}

}  // namespace
}  // namespace lightwell
