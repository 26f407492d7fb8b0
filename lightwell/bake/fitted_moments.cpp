// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/fitted_moments.h"

#include <algorithm>

#include "lightwell/light/record.h"

namespace lightwell {
namespace {

constexpr size_t count = std::tuple_size_v<Facings>;

/// What moments differ by for a normal that weighs most may stay by this share, so that two normals that are nearly the
/// same do not pull the numbers apart.
constexpr float least_rest = 0.05f;

/// The share of each of the nine numbers in the irradiance for a normal: see Moments::irradiance.
using Shares = std::array<float, 9>;

Shares shares_of(const Vec3f& n) {
  Shares shares{};
  for (int a = 0; a < 3; a++) {
    shares[static_cast<size_t>(2 * a)] = (n[a] * n[a] + n[a]) / 2;
    shares[static_cast<size_t>(2 * a + 1)] = (n[a] * n[a] - n[a]) / 2;
  }
  shares[6] = n[0] * n[1] / 2;
  shares[7] = n[0] * n[2] / 2;
  shares[8] = n[1] * n[2] / 2;
  return shares;
}

/// Solves a small symmetric positive system in place, by Gauss: `right` becomes the solution.
void solve(std::array<std::array<float, count>, count>& matrix, std::array<Vec3f, count>& right) {
  for (size_t k = 0; k < count; k++) {
    for (size_t row = k + 1; row < count; row++) {
      const float factor = matrix[row][k] / matrix[k][k];
      for (size_t column = k; column < count; column++) matrix[row][column] -= factor * matrix[k][column];
      right[row] += right[k] * -factor;
    }
  }
  for (size_t k = count; k-- > 0;) {
    for (size_t column = k + 1; column < count; column++) right[k] += right[column] * -matrix[k][column];
    right[k] = right[k] / matrix[k][k];
  }
}

void keep_within_bounds(Moments& moments) {
  for (size_t d = 0; d < 6; d++) moments.m[d] = max(moments.m[d], Vec3f{});
  for (size_t pair = 0; pair < 3; pair++) {
    const Vec3f bound = mixed_bound(moments, pair);
    moments.m[6 + pair] = max(-bound, min(moments.m[6 + pair], bound));
  }
}

}  // namespace

Moments fitted(const Moments& moments, const Facings& facings, std::span<const Vec3f> received) {
  std::array<Shares, count> shares;
  std::array<Vec3f, count> rest;
  std::array<std::array<float, count>, count> matrix{};
  float most = 0;
  for (const Facing& facing : facings) most = std::max(most, facing.weight);
  if (!(most > 0)) return moments;
  for (size_t i = 0; i < count; i++) {
    shares[i] = shares_of(facings[i].normal);
    Vec3f given{};
    for (size_t k = 0; k < shares[i].size(); k++) given += moments.m[k] * shares[i][k];
    rest[i] = facings[i].weight > 0 ? received[i] - given : Vec3f{};
    matrix[i][i] = facings[i].weight > 0 ? least_rest * most / facings[i].weight : 1;
    for (size_t j = 0; j <= i; j++) {
      float product = 0;
      for (size_t k = 0; k < shares[i].size(); k++) product += shares[i][k] * shares[j][k];
      if (facings[i].weight > 0 && facings[j].weight > 0) matrix[i][j] += product;
      matrix[j][i] = matrix[i][j];
    }
  }
  solve(matrix, rest);
  Moments moved = moments;
  for (size_t i = 0; i < count; i++)
    for (size_t k = 0; k < shares[i].size(); k++) moved.m[k] += rest[i] * shares[i][k];
  keep_within_bounds(moved);
  return moved;
}

}  // namespace lightwell
