// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/grid.h"

#include <gtest/gtest.h>

#include "tests/light/light_fields.h"

namespace lightwell {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
// Sums of a few dozen products of single precision.
constexpr float rounding = 2e-5f;

void expect_near(const Vec3f& a, const Vec3f& b, float tolerance) {
  for (int c = 0; c < 3; c++) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

TEST(GridShape, SpreadsNodesOverTheBox) {
  const GridShape shape = GridShape::over({{{1, 2, 3}}, {{9, 5, 7}}}, 33);
  EXPECT_EQ(shape.nodes, (Vec3i{{33, 13, 17}}));
  EXPECT_EQ(shape.lo, (Vec3f{{1, 2, 3}}));
  expect_near(shape.hi(), {{9, 5, 7}}, 1e-5f);
  for (size_t i = 0; i < shape.count(); i += 7) EXPECT_EQ(shape.index(shape.node(i)), i);
}

TEST(GridShape, ThickensFlatBoxesToACell) {
  const GridShape floor = GridShape::over({{{0, 1, 0}}, {{4, 1, 2}}}, 5);
  EXPECT_EQ(floor.nodes, (Vec3i{{5, 2, 3}}));
  expect_near(floor.lo, {{0, 0.5f, 0}}, 1e-6f);
  expect_near(floor.hi(), {{4, 1.5f, 2}}, 1e-6f);
  const GridShape point = GridShape::over({{{1, 1, 1}}, {{1, 1, 1}}}, 2);
  EXPECT_EQ(point.nodes, (Vec3i{{2, 2, 2}}));
  EXPECT_GT(point.cell[0], 0);
}

TEST(Moments, AreExactOnTheAxes) {
  Random random(1, 0);
  for (int i = 0; i < 100; i++) {
    const Moments m = parallel_light(random_direction(random), random_colour(random));
    for (size_t d = 0; d < 6; d++) {
      Vec3f n{};
      n[static_cast<int>(d / 2)] = d % 2 == 0 ? 1.0f : -1.0f;
      EXPECT_EQ(m.irradiance(n), m.m[d]);
    }
  }
}

TEST(Moments, AreExactInAUniformField) {
  Random random(2, 0);
  for (int i = 0; i < 100; i++) {
    expect_near(uniform_light({{1, 2, 3}}).irradiance(random_direction(random)), {{pi, 2 * pi, 3 * pi}}, rounding);
  }
}

// Radiance a + b.w + w.C w gives E(n) = pi a + 2 pi/3 b.n + pi/4 (tr C + n.C n) and S_ab = pi C_ab.
TEST(Moments, AreExactForRadianceOfDegreeTwo) {
  Random random(3, 0);
  const auto any = [&] { return 2 * random.uniform() - 1; };
  for (int i = 0; i < 100; i++) {
    const float level = 5;  // keeps the radiance positive
    const Vec3f b{{any(), any(), any()}};
    std::array<std::array<float, 3>, 3> c{};
    for (size_t row = 0; row < 3; row++) {
      for (size_t column = row; column < 3; column++) c[row][column] = c[column][row] = any();
    }
    const auto truth = [&](const Vec3f& n) {
      float quadratic = 0;
      for (size_t row = 0; row < 3; row++) {
        for (size_t column = 0; column < 3; column++)
          quadratic += n[static_cast<int>(row)] * c[row][column] * n[static_cast<int>(column)];
      }
      return pi * level + 2 * pi / 3 * dot(b, n) + pi / 4 * (c[0][0] + c[1][1] + c[2][2] + quadratic);
    };
    Moments m;
    for (size_t d = 0; d < 6; d++) {
      Vec3f n{};
      n[static_cast<int>(d / 2)] = d % 2 == 0 ? 1.0f : -1.0f;
      m.m[d] = Vec3f::filled(truth(n));
    }
    m.m[6] = Vec3f::filled(pi * c[0][1]);
    m.m[7] = Vec3f::filled(pi * c[0][2]);
    m.m[8] = Vec3f::filled(pi * c[1][2]);
    for (int k = 0; k < 20; k++) {
      const Vec3f n = random_direction(random);
      EXPECT_NEAR(m.irradiance(n)[0], truth(n), 10 * rounding);
    }
  }
}

// The papers' I_n = sum I_a n_a^2, E = I_n.n: docs/decisions/002-moments.md quotes this figure.
TEST(Moments, ThePapersFormulaLosesFortyTwoPercentOfAUniformField) {
  const Vec3f n = normalized(Vec3f{{1, 1, 1}});
  float papers = 0;
  for (int a = 0; a < 3; a++) papers += pi * n[a] * n[a] * n[a];  // I_a = pi a in a uniform field of radiance 1
  EXPECT_NEAR(1 - papers / pi, 0.4226f, 1e-4f);
  EXPECT_NEAR(uniform_light({{1, 1, 1}}).irradiance(n)[0], pi, rounding);
}

TEST(Moments, AreNeverNegative) {
  Moments m;
  m.m[6] = {{-3, -3, 3}};
  const Vec3f e = m.irradiance(normalized(Vec3f{{1, 1, 0}}));
  EXPECT_EQ(e[0], 0);
  EXPECT_GT(e[2], 0);
}

// E is linear between nodes where the light is.
TEST(LightGrid, InterpolatesLinearly) {
  GridShape shape = GridShape::over({{{0, 0, 0}}, {{1, 1, 1}}}, 5);
  LightGrid grid;
  grid.shape = shape;
  grid.valid.assign(shape.count(), 1);
  grid.normal_offset = 0;
  const auto light = [](const Vec3f& p) { return 1 + p[0] + 2 * p[1] + 3 * p[2]; };
  for (size_t i = 0; i < shape.count(); i++)
    grid.moments.push_back(uniform_light(Vec3f::filled(light(shape.position(shape.node(i))))));
  Random random(4, 0);
  for (int i = 0; i < 200; i++) {
    const Vec3f p = random_colour(random), n = random_direction(random);
    EXPECT_NEAR(grid.irradiance(p, n)[1], pi * light(p), 5 * rounding);
  }
  expect_near(grid.irradiance({{-3, 7, 0.5f}}, {{0, 0, 1}}), Vec3f::filled(pi * light({{0, 1, 0.5f}})), 5 * rounding);
}

TEST(LightGrid, LooksHalfACellAlongTheNormal) {
  Random random(5, 0);
  const LightGrid grid = lamp_grid(random_shape(random, 6), 6);
  LightGrid without = grid;
  without.normal_offset = 0;
  for (int i = 0; i < 50; i++) {
    const Vec3f p = grid.shape.lo + (grid.shape.hi() - grid.shape.lo) * random_colour(random),
                n = random_direction(random);
    const Vec3f moved = p + grid.shape.cell * n * 0.5f;
    const Vec3f a = grid.irradiance(p, n), b = without.irradiance(moved, n);
    expect_near(a, b, 1e-3f * (1 + max_component(b)));
  }
}

// The B-spline's own sum over 64 nodes, at places away from the borders, where nodes are missing.
TEST(LightGrid, TricubicIsTheSplineOverSixtyFourNodes) {
  Random random(8, 0);
  LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{3, 4, 5}}}, 9), 4, 0.5f);
  grid.normal_offset = 0;
  grid.lookup = LightLookup::tricubic;
  const auto spline = [](float x) {
    const float t = std::abs(x);
    return t < 1 ? (4 - 6 * t * t + 3 * t * t * t) / 6 : t < 2 ? (2 - t) * (2 - t) * (2 - t) / 6 : 0.0f;
  };
  for (int i = 0; i < 100; i++) {
    Vec3f place;
    for (int a = 0; a < 3; a++) place[a] = 1 + random.uniform() * static_cast<float>(grid.shape.cells()[a] - 2);
    const Vec3f normal = random_direction(random);
    Moments sum;
    for (size_t node = 0; node < grid.moments.size(); node++) {
      const Vec3f away = place - grid.shape.node(node).cast<float>();
      sum += grid.moments[node] * (spline(away[0]) * spline(away[1]) * spline(away[2]));
    }
    const Vec3f found = grid.irradiance(grid.shape.lo + place * grid.shape.cell, normal);
    const Vec3f wanted = sum.irradiance(normal);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(found[c], wanted[c], 1e-4f * (1 + wanted[c]));
  }
}

// Over nodes of 4, 3, 2, 1, 2, 3, 4 the slope of trilinear light jumps from -1 to 1 at the middle one; that of the
// spline passes through 0, with a second derivative of 2.
TEST(LightGrid, TricubicHasNoCreases) {
  LightGrid grid;
  grid.shape.nodes = {{9, 5, 5}};
  grid.normal_offset = 0;
  grid.valid.assign(grid.shape.count(), 1);
  for (size_t i = 0; i < grid.shape.count(); i++)
    grid.moments.push_back(uniform_light(Vec3f::filled((std::abs(grid.shape.node(i)[0] - 4.0f) + 1) / pi)));
  constexpr float step = 0.01f;
  const auto bend = [&](LightLookup lookup) {
    grid.lookup = lookup;
    const auto at = [&](float x) { return grid.irradiance({{4 + x, 2, 2}}, {{0, 1, 0}})[0]; };
    return at(step) - 2 * at(0) + at(-step);
  };
  EXPECT_NEAR(bend(LightLookup::trilinear), 2 * step, 1e-4f);
  EXPECT_NEAR(bend(LightLookup::tricubic), 2 * step * step, 1e-4f);
}

TEST(LightGrid, AnythingIsAPoint) {
  Random random(6, 0);
  const LightGrid grid = lamp_grid(random_shape(random, 3), 7);
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float strange : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 1e38f}) {
    EXPECT_TRUE(is_finite(grid.irradiance({{strange, 0, strange}}, {{0, 1, 0}})));
  }
}

// A bright room and a dark one with a layer of nodes inside the wall between: what crosses it is the weight of an
// invalid node times the filled value, at most 2^-13 over the weight of the valid nodes, here at least 0.1.
TEST(LightGrid, InvalidNodesDoNotLeak) {
  const GridShape shape = GridShape::over({{{0, 0, 0}}, {{10, 2, 2}}}, 11);
  LightGrid grid;
  grid.shape = shape;
  grid.moments.resize(shape.count());
  grid.valid.assign(shape.count(), 1);
  grid.normal_offset = 0;
  for (size_t i = 0; i < shape.count(); i++) {
    const int x = shape.node(i)[0];
    if (x < 5) grid.moments[i] = uniform_light({{1, 1, 1}});
    if (x == 5) grid.valid[i] = 0;
  }
  fill_invalid(grid);
  Random random(7, 0);
  for (int i = 0; i < 200; i++) {
    const float y = 2 * random.uniform(), z = 2 * random.uniform(), depth = 0.9f * random.uniform();
    EXPECT_LT(grid.irradiance({{5 + 0.1f + depth, y, z}}, {{1, 0, 0}})[0], pi * 0x1p-13f * 10);
    EXPECT_NEAR(grid.irradiance({{5 - 0.1f - depth, y, z}}, {{-1, 0, 0}})[0], pi, pi * 0x1p-13f * 10);
  }
}

// Inside the wall each side's surface normal finds its own room's light.
TEST(FillInvalid, TakesEachDirectionFromItsOwnSide) {
  const GridShape shape = GridShape::over({{{0, 0, 0}}, {{4, 2, 2}}}, 5);
  LightGrid grid;
  grid.shape = shape;
  grid.moments.resize(shape.count());
  grid.valid.assign(shape.count(), 1);
  grid.normal_offset = 0;
  for (size_t i = 0; i < shape.count(); i++) {
    const int x = shape.node(i)[0];
    grid.moments[i] = uniform_light(Vec3f::filled(x < 2 ? 1.0f : 0.0f));
    if (x == 2) grid.valid[i] = 0;
  }
  fill_invalid(grid);
  const Moments& filled = grid.moments[shape.index({{2, 1, 1}})];
  EXPECT_EQ(filled.m[0][0], 0);
  EXPECT_NEAR(filled.m[1][0], pi, rounding);
}

TEST(FillInvalid, KeepsUniformFieldsAndValidNodes) {
  Random random(8, 0);
  for (uint64_t seed = 0; seed < 20; seed++) {
    LightGrid grid = lamp_grid(random_shape(random, 8), seed, 0, true);
    const LightGrid before = grid;
    fill_invalid(grid);
    for (size_t i = 0; i < grid.moments.size(); i++) {
      if (grid.valid[i]) {
        EXPECT_EQ(grid.moments[i].m, before.moments[i].m);
      }
    }
    const bool any_valid = std::count(grid.valid.begin(), grid.valid.end(), 1) > 0;
    for (size_t i = 0; i < grid.moments.size(); i++) {
      if (grid.valid[i])
        grid.moments[i] = uniform_light({{1, 2, 3}});
      else
        grid.moments[i] = uniform_light({{9, 9, 9}});
    }
    fill_invalid(grid);
    for (const Moments& m : grid.moments) {
      if (any_valid) expect_near(m.irradiance({{0, 1, 0}}), {{pi, 2 * pi, 3 * pi}}, rounding);
    }
  }
}

TEST(FillInvalid, LeavesAGridOfSolidsAsItIs) {
  LightGrid grid = lamp_grid(GridShape{}, 1);
  grid.valid.assign(grid.valid.size(), 0);
  const LightGrid before = grid;
  fill_invalid(grid);
  for (size_t i = 0; i < grid.moments.size(); i++) EXPECT_EQ(grid.moments[i].m, before.moments[i].m);
}

}  // namespace
}  // namespace lightwell
