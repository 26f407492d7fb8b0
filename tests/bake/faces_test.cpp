// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/faces.h"

#include <gtest/gtest.h>

#include "lightwell/trace/sampling.h"
#include "tests/light/light_fields.h"

namespace lightwell {
namespace {

std::vector<Moments> moments(const FaceSums& sums, const GridShape& shape) {
  return sums.moments(1, std::vector<float>(shape.count(), 1.0f));
}

TEST(Faces, CountAPhotonByTheAreaOfTheFaceThatItCrosses) {
  const GridShape shape{.lo = {}, .cell = {{1, 2, 4}}, .nodes = {{3, 3, 3}}};
  FaceSums sums(shape);
  // Along +x from before the first plane to before the last: it crosses those of the nodes (0, 1, 1) and (1, 1, 1).
  sums.deposit({{-0.5f, 2.5f, 3}}, {{1, 0, 0}}, 2, {{1, 2, 4}});
  const std::vector<Moments> all = moments(sums, shape);
  for (const int x : {0, 1}) {
    EXPECT_NEAR(all[shape.index({{x, 1, 1}})].m[1][0], 1 / 8.0f, 1e-6f);  // light that flies along +x comes from -x
    EXPECT_NEAR(all[shape.index({{x, 1, 1}})].m[1][2], 4 / 8.0f, 1e-6f);
  }
  EXPECT_EQ(all[shape.index({{2, 1, 1}})].m[1], Vec3f{});
  EXPECT_EQ(all[shape.index({{1, 1, 1}})].m[0], Vec3f{});
  EXPECT_EQ(all[shape.index({{1, 1, 1}})].m[6], Vec3f{});
}

// Parallel light of 1 W/m2: one photon to a square of a fine lattice across it.
TEST(Faces, FindTheMomentsOfParallelLight) {
  const GridShape shape{.lo = {{-1, -1, -1}}, .cell = {{1, 0.5f, 0.8f}}, .nodes = {{3, 4, 3}}};
  Random random(1, 0);
  for (int i = 0; i < 12; i++) {
    Vec3f towards = random_direction(random);
    for (float& c : towards.e) c = std::copysign(std::max(std::abs(c), 0.2f), c);
    towards = normalized(towards);
    const Frame frame(towards);
    FaceSums sums(shape);
    constexpr int side = 400;
    constexpr float size = 8;
    for (int k = 0; k < side * side; k++) {
      const Vec3f place{{(static_cast<float>(k % side) + random.uniform()) / side - 0.5f,
                         (static_cast<float>(k / side) + random.uniform()) / side - 0.5f, 0}};
      const Vec3f origin = frame.to_world(place * size) + towards * 10.0f;
      sums.deposit(origin, -towards, std::numeric_limits<float>::infinity(),
                   Vec3f::filled(size * size / (side * side)));
    }
    const Moments expected = parallel_light(towards, Vec3f::filled(1));
    // The smallest face, a quarter of a cell, is crossed by some 30 photons of a jittered lattice: 6 % of noise at
    // most.
    for (const Moments& m : moments(sums, shape))
      for (size_t k = 0; k < 9; k++)
        EXPECT_NEAR(m.m[k][1], expected.m[k][1], 0.08f) << "moment " << k << " towards " << towards[0];
  }
}

// R09's weights find the integral of cos^2 over a half-space where that of cos is asked for: two thirds of it. 40,000
// photons leave 1 % of the sums of all nodes; three times that.
TEST(Faces, AsPrintedFindTwoThirdsOfUniformLight) {
  const GridShape shape{.lo = Vec3f::filled(-1), .cell = Vec3f::filled(0.5f), .nodes = {{5, 5, 5}}};
  FaceSums corrected(shape), printed(shape, true);
  Random random(1, 0);
  for (int i = 0; i < 40000; i++) {
    const Vec3f towards = sample_sphere(random);
    const Frame frame(towards);
    const Vec3f origin = frame.to_world(sample_disc(random)) * 1.8f - towards * 3.0f;
    for (FaceSums* sums : {&corrected, &printed}) sums->deposit(origin, towards, 10, Vec3f::filled(1));
  }
  Moments right, found;
  for (const Moments& m : moments(corrected, shape)) right += m;
  for (const Moments& m : moments(printed, shape)) found += m;
  for (size_t d = 0; d < 6; d++) EXPECT_NEAR(found.m[d][0] / right.m[d][0], 2 / 3.0f, 0.02f);
}

TEST(Faces, AddUpInAnyOrder) {
  const GridShape shape{.lo = {}, .cell = Vec3f::filled(0.5f), .nodes = {{5, 4, 3}}};
  Random random(2, 0);
  FaceSums one(shape), first(shape), second(shape);
  for (int i = 0; i < 500; i++) {
    const Vec3f origin = random_colour(random) * 3 - Vec3f::filled(0.5f), direction = random_direction(random);
    const Vec3f weight = random_colour(random) * 1e3f;
    one.deposit(origin, direction, 1, weight);
    (i % 3 == 0 ? first : second).deposit(origin, direction, 1, weight);
  }
  second += first;
  const std::vector<Moments> a = moments(one, shape), b = moments(second, shape);
  for (size_t i = 0; i < a.size(); i++) EXPECT_EQ(a[i].m, b[i].m);
}

}  // namespace
}  // namespace lightwell
