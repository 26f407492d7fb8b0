// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/random.h"
#include "lightwell/base/vector.h"

namespace lightwell {

/// Gradient noise (Perlin, "Improving Noise", 2002) with a seed: smooth, zero on the integer lattice, within about
/// [-1, 1], with features of about one unit.
class GradientNoise {
 public:
  explicit GradientNoise(uint64_t seed) : seed_(hash64(seed + 1)) {}

  float at(const Vec3f& p) const {
    Vec3i cell;
    Vec3f in, weight;
    for (int a = 0; a < 3; a++) {
      const float floor = std::floor(p[a]);
      cell[a] = static_cast<int>(floor);
      in[a] = p[a] - floor;
      weight[a] = in[a] * in[a] * in[a] * (in[a] * (in[a] * 6 - 15) + 10);
    }
    float sum = 0;
    for (int corner = 0; corner < 8; corner++) {
      const Vec3i step{{corner & 1, corner >> 1 & 1, corner >> 2}};
      float share = 1;
      for (int a = 0; a < 3; a++) share *= step[a] ? weight[a] : 1 - weight[a];
      sum += share * slope(cell + step, in - step.cast<float>());
    }
    return sum;
  }

 private:
  /// The dot product of `offset` with the lattice point's gradient, one of the twelve edges of a cube.
  float slope(const Vec3i& lattice, const Vec3f& offset) const {
    uint64_t hash = seed_;
    for (int a = 0; a < 3; a++) hash = hash64(hash + static_cast<uint32_t>(lattice[a]));
    const int axis = static_cast<int>((hash & 0xffff) * 3 >> 16);
    const float u = offset[(axis + 1) % 3], v = offset[(axis + 2) % 3];
    return (hash >> 16 & 1 ? u : -u) + (hash >> 17 & 1 ? v : -v);
  }

  uint64_t seed_;
};

}  // namespace lightwell
