// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/open_sky.h"

#include <algorithm>

namespace lightwell {
namespace {

constexpr size_t directions = 16'384;

std::array<float, 4> with_one(const Vec3f& n) { return {n[0], n[1], n[2], 1}; }

/// Of the second, first and zeroth moments of the radiance in the irradiance.
float weight(size_t i, size_t j) {
  if (i < 3 && j < 3) return 15.0f / 32;
  return i == j ? 3.0f / 32 : 1.0f / 4;
}

}  // namespace

OpenSky::OpenSky(const EnvironmentLight& environment) {
  for (size_t d = 0; d < directions; d++) {
    const Vec3f direction = sphere_direction(d, directions, 0.5f, 0.5f);
    const Vec3f light = environment.radiance(direction) * (4 * pi / static_cast<float>(directions));
    const std::array<float, 4> along = with_one(direction);
    for (size_t i = 0; i < 4; i++)
      for (size_t j = 0; j < 4; j++) matrix_[i][j] += light * (weight(i, j) * along[i] * along[j]);
  }
}

Vec3f OpenSky::irradiance(const Vec3f& normal) const {
  const std::array<float, 4> n = with_one(normal);
  Vec3f sum{};
  for (size_t i = 0; i < 4; i++)
    for (size_t j = 0; j < 4; j++) sum += matrix_[i][j] * (n[i] * n[j]);
  for (float& channel : sum.e) channel = std::max(channel, 0.0f);
  return sum;
}

Vec3f OpenSky::mean() const { return matrix_[3][3] + (matrix_[0][0] + matrix_[1][1] + matrix_[2][2]) / 3; }

}  // namespace lightwell
