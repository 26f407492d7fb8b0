// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightwell/light/grid.h"

namespace lightwell {

/// Sums of the photons that cross faces round the nodes of a grid (R09, Pacanowski et al., "Volumetric Vector-Based
/// Representation for Indirect Illumination Caching", INRIA RR-6983, 2009), from which the moments of their light are
/// estimated. A node has three faces, each across an axis, half a cell to each side and not beyond the grid, of area A.
/// A photon of flux p in direction -w that crosses the face across a adds p / A to E_{sgn(w_a) a}, and p sgn(w_a) w_b /
/// (2 A |w_a|) to S_ab. R09 divides by A alone, without the cosine by which a slanted photon sees less of the face: in
/// uniform light it finds two thirds. The sums are integers, so the order of the flights does not matter.
class FaceSums {
 public:
  /// `as_printed`: each photon's w p / A goes into the half-space's vector as in R09, without the cosine. For
  /// comparison.
  explicit FaceSums(const GridShape& shape, bool as_printed = false);

  /// Adds a photon's flight. `weight` is its flux relative to the one that moments() is given, of the order of 1. The
  /// flight may begin and end outside the grid and be infinitely long.
  void deposit(const Vec3f& origin, const Vec3f& direction, float length, const Vec3f& weight);
  /// Adds the sums of another grid of the same shape.
  FaceSums& operator+=(const FaceSums& other);

  /// The moments of each node, W/m2. `flux` is that of a photon of weight 1, W; `free_share` is the share of each
  /// node's box that is free space, which stands for that of its faces. A node without free space gets zeros.
  std::vector<Moments> moments(float flux, std::span<const float> free_share) const;

  static size_t bytes(const GridShape& shape) { return shape.count() * lanes * sizeof(int64_t); }

 private:
  static constexpr size_t lanes = 27;  // nine moments of three colours

  void cross(int axis, const Vec3i& node, const Vec3f& w, const Vec3f& weight);

  GridShape shape_;
  bool as_printed_;
  float unit_;                 // of length: the longest side of a cell
  std::vector<int64_t> sums_;  // of weight, divided by the area of a face in square units
};

}  // namespace lightwell
