// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lamp_points.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

namespace lightwell {
namespace {

// Every 2^k points from a multiple of 2^k on have one in each of 2^k equal parts of the square, whatever their sides: a
// (0, 2)-sequence in base 2 (H. Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, 1992).
TEST(LampPoints, CoverTheSquareEvenly) {
  for (uint32_t k = 1; k <= 10; k++)
    for (const uint32_t first : {0u, 1u << k, 3u << k})
      for (uint32_t columns = 0; columns <= k; columns++) {
        std::set<std::pair<int, int>> parts;
        for (uint32_t i = first; i < first + (1u << k); i++) {
          const Vec2f at = progressive_point(i);
          parts.insert({static_cast<int>(std::ldexp(at[0], static_cast<int>(columns))),
                        static_cast<int>(std::ldexp(at[1], static_cast<int>(k - columns)))});
        }
        EXPECT_EQ(parts.size(), size_t(1) << k) << first << " " << columns;
      }
}

// As squareOf() of web/src/three/direct/lamp_points.ts gives them.
TEST(LampPoints, AreThoseOfThePage) {
  const auto expect_at = [](uint32_t index, float x, float y) {
    EXPECT_FLOAT_EQ(progressive_point(index)[0], x);
    EXPECT_FLOAT_EQ(progressive_point(index)[1], y);
  };
  expect_at(0, 0.333333333f, 0.333333333f);
  expect_at(1, 0.833333333f, 0.833333333f);
  expect_at(2, 0.083333333f, 0.583333333f);
  expect_at(5, 0.958333333f, 0.458333333f);
  expect_at(1000, 0.260091146f, 0.484700521f);
}

TEST(LampPoints, HaveTheirMeanInTheMiddle) {
  for (const uint32_t count : {4u, 16u, 64u, 256u}) {
    Vec2f mean{};
    for (uint32_t i = 0; i < count; i++) mean += progressive_point(i) / static_cast<float>(count);
    // Without the shift each coordinate's mean is half of 1 / count below the middle; with it a third of that.
    EXPECT_NEAR(mean[0], 0.5f, 0.2f / static_cast<float>(count)) << count;
    EXPECT_NEAR(mean[1], 0.5f, 0.2f / static_cast<float>(count)) << count;
  }
}

TEST(LampPoints, AreOnTheLamp) {
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::rectangle;
  lamp.center = {{1, 2, 3}};
  lamp.normal = {{0, 1, 0}};
  lamp.half_u = {{0.5f, 0, 0}};
  lamp.half_v = {{0, 0, 2}};
  for (uint32_t i = 0; i < 100; i++) {
    const Vec3f place = lamp_point(lamp, i).position - lamp.center;
    EXPECT_LE(std::abs(place[0]), 0.5f);
    EXPECT_EQ(place[1], 0);
    EXPECT_LE(std::abs(place[2]), 2);
  }
  // Of a disc as many are in each half of its area, whichever way it is cut.
  lamp.kind = ClientLamp::Kind::disc;
  lamp.radius = 0.3f;
  int inner = 0, left = 0;
  for (uint32_t i = 0; i < 256; i++) {
    const Vec3f place = lamp_point(lamp, i).position - lamp.center;
    EXPECT_LE(length(place), 0.3f * (1 + 1e-6f));
    EXPECT_NEAR(place[1], 0, 1e-6f);
    inner += length(place) < 0.3f * std::numbers::sqrt2_v<float> / 2;
    left += place[0] + 0.3f * place[2] < 0;
  }
  EXPECT_NEAR(inner, 128, 8);
  EXPECT_NEAR(left, 128, 8);
  lamp.kind = ClientLamp::Kind::sphere;
  Vec3f mean{};
  for (uint32_t i = 0; i < 256; i++) {
    const LampPoint point = lamp_point(lamp, i);
    EXPECT_NEAR(length(point.position - lamp.center), 0.3f, 1e-6f);
    EXPECT_NEAR(length(point.normal), 1, 1e-6f);
    mean += point.normal / 256.0f;
  }
  EXPECT_LT(length(mean), 0.01f);
}

}  // namespace
}  // namespace lightwell
