// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/sampling.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/trace/chi_square.h"

namespace lightwell {
namespace {

constexpr int samples = 200000;

/// One of `count` equal parts of [lo, hi].
size_t part(float x, float lo, float hi, size_t count) {
  const float share = std::clamp((x - lo) / (hi - lo), 0.0f, 0.999999f);
  return static_cast<size_t>(share * static_cast<float>(count));
}

float angle_of(float x, float y) { return std::atan2(y, x); }

/// The chi-square of samples whose place in a square of 16 x 16 parts, each as probable, `place` tells.
template <typename Place>
double chi_square_of_square(uint64_t seed, const Place& place) {
  std::vector<int> counts(256);
  Random random(seed, 0);
  for (int i = 0; i < samples; i++) {
    const auto [row, column] = place(random);
    counts[16 * row + column]++;
  }
  return chi_square_of_equal_bins(counts);
}

std::vector<Vec3f> awkward_normals() {
  std::vector<Vec3f> normals;
  for (int axis = 0; axis < 3; axis++) {
    for (const float sign : {1.0f, -1.0f}) {
      Vec3f pole = Vec3f::filled(-0.0f);
      pole[axis] = sign;
      normals.push_back(pole);
      for (const float aside : {1e-3f, 1e-7f, 1e-20f}) {
        Vec3f near = pole;
        near[(axis + 1) % 3] = aside;
        near[(axis + 2) % 3] = -aside;
        normals.push_back(normalized(near));
      }
    }
  }
  Random random(1, 0);
  for (int i = 0; i < 1000; i++) normals.push_back(sample_sphere(random));
  return normals;
}

TEST(Frame, IsRightHandedAndOrthonormalAlsoAtThePoles) {
  for (const Vec3f& normal : awkward_normals()) {
    const Frame frame(normal);
    EXPECT_EQ(frame.z, normal);
    // Some roundings of numbers up to 1.
    EXPECT_NEAR(length(frame.x), 1, 1e-6f);
    EXPECT_NEAR(length(frame.y), 1, 1e-6f);
    EXPECT_NEAR(length(cross(frame.x, frame.y) - normal), 0, 1e-6f);
    const Vec3f v{{0.3f, -0.5f, 0.7f}};
    EXPECT_NEAR(length(frame.to_world(frame.to_local(v)) - v), 0, 1e-6f);
  }
}

TEST(SampleCosineHemisphere, HasACosinesDensityAroundAnyNormal) {
  for (const Vec3f& normal : {Vec3f{{0, 0, -1}}, Vec3f{{0, 1, 0}}, normalized(Vec3f{{1, -2, 0.5f}})}) {
    const Frame frame(normal);
    // Malley: projected onto the plane the directions are uniform in the disc, and so is the square of the cosine.
    const double probability = chi_square_of_square(2, [&](Random& random) {
      const Vec3f v = frame.to_local(sample_cosine_hemisphere(normal, random));
      EXPECT_GE(v[2], 0);
      EXPECT_NEAR(length(v), 1, 1e-5f);
      return std::pair(part(v[2] * v[2], 0, 1, 16), part(angle_of(v[0], v[1]), -pi, pi, 16));
    });
    EXPECT_GT(probability, least_probability);
  }
}

TEST(SampleSphere, IsUniform) {
  // Archimedes: each coordinate is uniform.
  for (int axis = 0; axis < 3; axis++) {
    const double probability = chi_square_of_square(3, [&](Random& random) {
      const Vec3f v = sample_sphere(random);
      EXPECT_NEAR(length(v), 1, 1e-5f);
      return std::pair(part(v[axis], -1, 1, 16), part(angle_of(v[(axis + 1) % 3], v[(axis + 2) % 3]), -pi, pi, 16));
    });
    EXPECT_GT(probability, least_probability);
  }
}

// Direction i of `count` taken by itself, for a random i, turn and shift.
TEST(SphereDirection, IsUniform) {
  const double probability = chi_square_of_square(8, [](Random& random) {
    const size_t i = random.below(50);
    const float u = random.uniform(), v = random.uniform();
    const Vec3f direction = sphere_direction(i, 50, u, v);
    EXPECT_NEAR(length(direction), 1, 1e-5f);
    return std::pair(part(direction[2], -1, 1, 16), part(angle_of(direction[0], direction[1]), -pi, pi, 16));
  });
  EXPECT_GT(probability, least_probability);
}

TEST(CosineDirection, HasACosinesDensity) {
  const double probability = chi_square_of_square(9, [](Random& random) {
    const size_t i = random.below(50);
    const float u = random.uniform(), v = random.uniform();
    const Vec3f direction = cosine_direction(i, 50, u, v);
    EXPECT_GE(direction[2], 0);
    EXPECT_NEAR(length(direction), 1, 1e-5f);
    return std::pair(part(direction[2] * direction[2], 0, 1, 16),
                     part(angle_of(direction[0], direction[1]), -pi, pi, 16));
  });
  EXPECT_GT(probability, least_probability);
}

TEST(SampleDisc, IsUniform) {
  const double probability = chi_square_of_square(4, [](Random& random) {
    const Vec3f v = sample_disc(random);
    EXPECT_EQ(v[2], 0);
    return std::pair(part(dot(v, v), 0, 1, 16), part(angle_of(v[0], v[1]), -pi, pi, 16));
  });
  EXPECT_GT(probability, least_probability);
}

TEST(SampleTriangle, IsUniform) {
  // 16 strips along each of two sides cut the triangle into 256 congruent ones.
  const double probability = chi_square_of_square(5, [](Random& random) {
    const Vec2f b = sample_triangle(random);
    EXPECT_GE(b[0], 0);
    EXPECT_GE(b[1], 0);
    EXPECT_LE(b[0] + b[1], 1 + 1e-6f);
    size_t row = part(b[0], 0, 1, 16), column = part(b[1], 0, 1, 16);
    const size_t diagonal = part(b[0] + b[1], 0, 1, 16);
    // A triangle that points the other way takes the free place on the other side of the diagonal.
    if (diagonal > row + column) return std::pair(15 - row, 15 - column);
    return std::pair(row, std::min(column, 15 - row));
  });
  EXPECT_GT(probability, least_probability);
}

TEST(PowerHeuristic, SharesASampleOutCompletely) {
  for (const float a : {1e-30f, 1e-3f, 1.0f, 7.0f, 1e25f}) {
    for (const float b : {1e-30f, 1e-3f, 1.0f, 7.0f, 1e25f}) {
      EXPECT_NEAR(power_heuristic(a, b) + power_heuristic(b, a), 1, 1e-6f) << a << " " << b;
    }
    EXPECT_EQ(power_heuristic(a, 0), 1);
    EXPECT_EQ(power_heuristic(0, a), 0);
  }
  EXPECT_EQ(power_heuristic(0, 0), 0);
  EXPECT_NEAR(power_heuristic(3, 1), 0.9f, 1e-6f);
}

TEST(Distribution, ChoosesByWeight) {
  Random random(6, 0);
  std::vector<float> weights(100);
  for (float& weight : weights) weight = random.below(3) == 0 ? 0.0f : std::pow(10.0f, 4 * random.uniform() - 2);
  weights.front() = weights.back() = 0;
  const Distribution distribution(weights);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  EXPECT_NEAR(distribution.total(), total, 1e-9 * total);
  ASSERT_EQ(distribution.size(), weights.size());
  std::vector<int> counts(weights.size());
  std::vector<double> shares;
  for (size_t i = 0; i < weights.size(); i++) {
    shares.push_back(static_cast<double>(weights[i]) / total);
    EXPECT_NEAR(static_cast<double>(distribution.probability(i)), shares[i], 1e-6);
  }
  for (int i = 0; i < samples; i++) counts[distribution.sample(random)]++;
  EXPECT_GT(chi_square(counts, shares), least_probability);
}

// A million equal weights need more bits than the 24 of a float's fraction.
TEST(Distribution, ReachesEveryPartOfManyWeights) {
  const size_t size = 1 << 20;
  const Distribution distribution(std::vector<float>(size, 0.1f));
  std::vector<int> counts(1024);
  int odd = 0;
  Random random(7, 0);
  for (int i = 0; i < samples; i++) {
    const size_t index = distribution.sample(random);
    ASSERT_LT(index, size);
    counts[index / 1024]++;
    odd += index % 2;
  }
  EXPECT_GT(chi_square_of_equal_bins(counts), least_probability);
  EXPECT_GT(chi_square_of_equal_bins({odd, samples - odd}), least_probability);
}

TEST(Distribution, OfNothingHasNoTotal) {
  EXPECT_EQ(Distribution().total(), 0);
  EXPECT_EQ(Distribution(std::vector<float>{}).size(), 0u);
  EXPECT_EQ(Distribution(std::vector<float>{0, 0}).total(), 0);
}

}  // namespace
}  // namespace lightwell
