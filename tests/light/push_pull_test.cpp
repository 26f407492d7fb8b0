// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/push_pull.h"

#include <gtest/gtest.h>

#include "tests/light/light_fields.h"

namespace lightwell {
namespace {

constexpr std::array fills{Fill::none, Fill::push_pull, Fill::push_pull_smooth};

std::vector<uint8_t> random_mask(Random& random, size_t count, float density) {
  std::vector<uint8_t> known(count);
  for (uint8_t& k : known) k = random.uniform() < density;
  return known;
}

// Grids of every size from 2x2x2 on, few and many nodes known, solids among them.
template <typename Body>
void for_many_grids(const Body& body) {
  Random random(1, 0);
  for (uint64_t seed = 0; seed < 60; seed++) {
    const GridShape shape = random_shape(random, 11);
    const LightGrid grid = lamp_grid(shape, seed, 0.1f, seed % 2 == 1);
    const float density = seed % 10 == 0 ? 0 : seed % 10 == 1 ? 1 : random.uniform() * random.uniform();
    body(grid, random_mask(random, shape.count(), density));
  }
}

TEST(PushPull, NeverChangesWhatWasReceived) {
  for_many_grids([](const LightGrid& grid, const std::vector<uint8_t>& known) {
    for (const Fill fill : fills) {
      LightGrid filled = grid;
      push_pull(filled, known, fill);
      for (size_t i = 0; i < known.size(); i++) {
        if (!known[i]) continue;
        EXPECT_EQ(filled.moments[i].m, grid.moments[i].m);
        EXPECT_EQ(filled.valid[i], grid.valid[i]);
      }
    }
  });
}

// Interpolation and means stay between the smallest and the largest known number.
TEST(PushPull, StaysWithinWhatIsKnown) {
  for_many_grids([](const LightGrid& grid, const std::vector<uint8_t>& known) {
    if (std::find(known.begin(), known.end(), 1) == known.end()) return;
    Vec3f lo = Vec3f::filled(1e30f), hi = Vec3f::filled(-1e30f);
    for (size_t i = 0; i < known.size(); i++) {
      if (known[i]) lo = min(lo, grid.moments[i].m[2]), hi = max(hi, grid.moments[i].m[2]);
    }
    for (const Fill fill : {Fill::push_pull, Fill::push_pull_smooth}) {
      LightGrid filled = grid;
      push_pull(filled, known, fill);
      for (const Moments& m : filled.moments) {
        for (int c = 0; c < 3; c++) {
          EXPECT_GE(m.m[2][c], lo[c] * (1 - 1e-5f));
          EXPECT_LE(m.m[2][c], hi[c] * (1 + 1e-5f));
        }
      }
    }
  });
}

TEST(PushPull, KeepsConstantFieldsExactly) {
  Random random(2, 0);
  for_many_grids([&](const LightGrid& grid, const std::vector<uint8_t>& known) {
    if (std::find(known.begin(), known.end(), 1) == known.end()) return;
    const Moments constant = parallel_light(random_direction(random), random_colour(random));
    for (const Fill fill : {Fill::push_pull, Fill::push_pull_smooth}) {
      LightGrid filled = grid;
      for (size_t i = 0; i < known.size(); i++) filled.moments[i] = known[i] ? constant : Moments{};
      push_pull(filled, known, fill);
      for (const Moments& m : filled.moments) ASSERT_EQ(m.m, constant.m);
    }
  });
}

TEST(PushPull, LeavesHolesDarkWhenToldSo) {
  Random random(3, 0);
  LightGrid grid = lamp_grid(random_shape(random, 5), 1);
  const std::vector<uint8_t> known = random_mask(random, grid.valid.size(), 0.5f);
  push_pull(grid, known, Fill::none);
  for (size_t i = 0; i < known.size(); i++) EXPECT_EQ(max_component(grid.moments[i].m[0]) > 0, known[i] != 0);
}

TEST(PushPull, IsDarkWhenNothingIsKnown) {
  LightGrid grid = lamp_grid(GridShape{}, 1);
  push_pull(grid, std::vector<uint8_t>(8, 0), Fill::push_pull);
  for (const Moments& m : grid.moments) EXPECT_EQ(m.m, Moments{}.m);
  EXPECT_EQ(grid.valid, std::vector<uint8_t>(8, 1));
}

// Half of the nodes of a smooth field: what is filled is far closer to the truth than darkness, and half the error of
// taking the mean of all.
TEST(PushPull, ApproximatesSmoothLight) {
  Random random(4, 0);
  const LightGrid truth = lamp_grid(GridShape::over({{{0, 0, 0}}, {{4, 4, 4}}}, 17), 5);
  const std::vector<uint8_t> known = random_mask(random, truth.valid.size(), 0.5f);
  Moments mean;
  for (const Moments& m : truth.moments) mean += m * (1.0f / static_cast<float>(truth.moments.size()));
  for (const Fill fill : {Fill::push_pull, Fill::push_pull_smooth}) {
    LightGrid filled = truth;
    push_pull(filled, known, fill);
    double error = 0, spread = 0;
    for (size_t i = 0; i < known.size(); i++) {
      const Vec3f a = filled.moments[i].m[0] - truth.moments[i].m[0], b = mean.m[0] - truth.moments[i].m[0];
      if (!known[i]) error += dot(a, a), spread += dot(b, b);
    }
    EXPECT_LT(std::sqrt(error / spread), 0.5);
  }
}

// A missing node takes the validity of most of its surroundings, and the light of the valid ones among them.
TEST(PushPull, GuessesValidity) {
  const GridShape shape = GridShape::over({{{0, 0, 0}}, {{7, 7, 7}}}, 8);
  LightGrid grid;
  grid.shape = shape;
  grid.moments.assign(shape.count(), uniform_light({{1, 1, 1}}));
  grid.valid.assign(shape.count(), 1);
  std::vector<uint8_t> known(shape.count(), 1);
  for (size_t i = 0; i < shape.count(); i++) {
    if (shape.node(i)[0] >= 4) {
      grid.valid[i] = 0;
      grid.moments[i] = uniform_light({{9, 9, 9}});
    }
  }
  known[shape.index({{1, 3, 3}})] = 0;
  known[shape.index({{6, 3, 3}})] = 0;
  const size_t beside = shape.index({{3, 3, 3}});
  known[beside] = 0;
  push_pull(grid, known, Fill::push_pull);
  EXPECT_EQ(grid.valid[shape.index({{1, 3, 3}})], 1);
  EXPECT_EQ(grid.valid[shape.index({{6, 3, 3}})], 0);
  EXPECT_EQ(grid.valid[beside], 1);
}

}  // namespace
}  // namespace lightwell
