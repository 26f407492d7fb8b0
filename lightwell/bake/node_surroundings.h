// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "lightwell/light/grid.h"

namespace lightwell {

/// A normal of surfaces whose lookups reach a node, and how much they do.
struct Facing {
  Vec3f normal{};
  float weight = 0;  ///< 0: there is none
};
/// Those that reach a node most.
using Facings = std::array<Facing, 4>;

/// What rays in all directions from a place find.
struct NodeSurroundings {
  Moments moments;    ///< W/m2
  float insides = 0;  ///< share of the rays that met the inside of a solid
  float noise = 0;    ///< of the moments, as a share of them: half of the rays against the other half
  uint32_t rays = 0;
  float behind = 0;                                          ///< share of the surfaces met that were met from the back
  std::array<Vec3f, std::tuple_size_v<Facings>> received{};  ///< W/m2, by the normals that were asked for
};

/// What rays from the front of a surface find.
struct Received {
  Vec3f irradiance{};  ///< W/m2
  float insides = 0;   ///< share of the rays that met the inside of a solid
};

/// The sum of the sizes of E in all directions and colours.
inline float size_of(const Moments& moments) {
  float sum = 0;
  for (size_t d = 0; d < 6; d++)
    for (int c = 0; c < 3; c++) sum += std::abs(moments.m[d][c]);
  return sum;
}

}  // namespace lightwell
