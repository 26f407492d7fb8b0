// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lightwell/light/grid.h"

namespace lightwell {

/// Sums of photons' track lengths at the nodes of a grid, from which the moments of their light are estimated
/// (docs/decisions/003-track-estimator.md). A node's box reaches half a cell to each side, and not beyond the grid. A
/// flight in direction -w that crosses the box on a length l adds weight * l * |w_a| to E_{sgn(w_a) a}, and weight * l
/// * (sgn(w_a) w_b + sgn(w_b) w_a) / 2 to S_ab. The sums are integers, so the order of the flights does not matter.
class TrackSums {
 public:
  explicit TrackSums(const GridShape& shape);

  /// Adds a photon's flight. `weight` is its flux relative to the one that moments() is given, of the order of 1. The
  /// flight may begin and end outside the grid and be infinitely long.
  void deposit(const Vec3f& origin, const Vec3f& direction, float length, const Vec3f& weight);
  /// Adds the sums of another grid of the same shape.
  TrackSums& operator+=(const TrackSums& other);

  /// The moments of each node, W/m2. `flux` is that of a photon of weight 1, W; `free_share` is the share of each
  /// node's box that is free space. A node without free space gets zeros.
  std::vector<Moments> moments(float flux, std::span<const float> free_share) const;

  static size_t bytes(const GridShape& shape) { return shape.count() * lanes * sizeof(int64_t); }

 private:
  static constexpr size_t used_lanes = 27;  // nine moments of three colours
  static constexpr size_t lanes = 28;       // padded to a multiple of four for vector instructions

  GridShape shape_;
  float unit_ = 1;  // unit of length: the longest side of a cell
  std::vector<int64_t> sums_;
};

/// The box of a node: half a cell to each side, clipped to the grid.
Box3f node_box(const GridShape& shape, size_t node);

}  // namespace lightwell
