// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/sampling.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

Frame::Frame(const Vec3f& normal) : z(normal) {
  const float sign = std::copysign(1.0f, z[2]);
  const float a = -1 / (sign + z[2]);
  const float b = z[0] * z[1] * a;
  x = {{1 + sign * z[0] * z[0] * a, sign * b, -sign * z[0]}};
  y = {{b, sign + z[1] * z[1] * a, -z[1]}};
}

Vec3f sample_cosine_hemisphere(const Vec3f& normal, Random& random) {
  const Vec3f disc = sample_disc(random);
  return Frame(normal).to_world({{disc[0], disc[1], std::sqrt(1 - dot(disc, disc))}});
}

Vec3f sample_sphere(Random& random) {
  const float z = 1 - 2 * random.uniform();
  const float radius = std::sqrt(std::max(0.0f, 1 - z * z));
  const float angle = 2 * pi * random.uniform();
  return {{radius * std::cos(angle), radius * std::sin(angle), z}};
}

namespace {

/// The direction of height z on turn i of a Fibonacci spiral.
Vec3f on_spiral(float z, size_t i, float v) {
  const float turn = std::numbers::phi_v<float> * static_cast<float>(i) + v;
  const float azimuth = 2 * pi * (turn - std::floor(turn));
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {{r * std::cos(azimuth), r * std::sin(azimuth), z}};
}

}  // namespace

Vec3f sphere_direction(size_t i, size_t count, float u, float v) {
  return on_spiral(1 - 2 * (static_cast<float>(i) + u) / static_cast<float>(count), i, v);
}

Vec3f cosine_direction(size_t i, size_t count, float u, float v) {
  return on_spiral(std::sqrt(1 - (static_cast<float>(i) + u) / static_cast<float>(count)), i, v);
}

Vec3f sample_disc(Random& random) {
  // Rejection from the square is cheaper than sine and cosine.
  for (;;) {
    const float x = 2 * random.uniform() - 1, y = 2 * random.uniform() - 1;
    if (x * x + y * y < 1) return {{x, y, 0}};
  }
}

Vec2f sample_triangle(Random& random) {
  const float root = std::sqrt(random.uniform());
  const float share = random.uniform();
  return {{root * (1 - share), root * share}};
}

Distribution::Distribution(const std::vector<float>& weights) {
  reserve(weights.size());
  for (const float weight : weights) add(static_cast<double>(weight));
}

Distribution::Place Distribution::at(double share) const {
  const double target = share * total();
  // Rounding may take a share of nearly 1 to the end.
  const auto found = std::min(std::upper_bound(cumulative_.begin(), cumulative_.end(), target), cumulative_.end() - 1);
  const double below = found == cumulative_.begin() ? 0 : *(found - 1), weight = *found - below;
  return {static_cast<size_t>(found - cumulative_.begin()), weight > 0 ? (target - below) / weight : 0};
}

float Distribution::probability(size_t index) const {
  const double below = index == 0 ? 0 : cumulative_[index - 1];
  return static_cast<float>((cumulative_[index] - below) / total());
}

}  // namespace lightwell
