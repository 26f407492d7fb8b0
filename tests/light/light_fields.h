// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lightwell/base/random.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// Light fields whose moments and irradiance are known in closed form.

inline Vec3f random_direction(Random& random) {
  const float z = 2 * random.uniform() - 1, azimuth = 2 * std::numbers::pi_v<float> * random.uniform();
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {{r * std::cos(azimuth), r * std::sin(azimuth), z}};
}

inline Vec3f random_colour(Random& random) { return {{random.uniform(), random.uniform(), random.uniform()}}; }

/// Moments of parallel light of irradiance `power` on a surface facing `towards` (docs/light.md section 1).
inline Moments parallel_light(const Vec3f& towards, const Vec3f& power) {
  const auto sign = [](float v) { return v < 0 ? -1.0f : 1.0f; };
  const auto mixed = [&](int a, int b) {
    return power * (0.5f * (sign(towards[a]) * towards[b] + sign(towards[b]) * towards[a]));
  };
  Moments m;
  for (int a = 0; a < 3; a++) {
    m.m[static_cast<size_t>(2 * a)] = power * std::max(0.0f, towards[a]);
    m.m[static_cast<size_t>(2 * a + 1)] = power * std::max(0.0f, -towards[a]);
  }
  m.m[6] = mixed(0, 1);
  m.m[7] = mixed(0, 2);
  m.m[8] = mixed(1, 2);
  return m;
}

/// Moments of the same radiance from everywhere.
inline Moments uniform_light(const Vec3f& radiance) {
  Moments m;
  for (size_t d = 0; d < 6; d++) m.m[d] = radiance * std::numbers::pi_v<float>;
  return m;
}

/// A grid of any shape in a soft light and that of a few small lamps around; `noise` is the relative standard deviation
/// of each lamp's light at a node. One node in ten is invalid when `solids` is set, in clumps.
inline LightGrid lamp_grid(const GridShape& shape, uint64_t seed, float noise = 0, bool solids = false) {
  Random random(seed, 0);
  struct Bulb {
    Vec3f place, power;
  };
  std::vector<Bulb> lamps;
  const Vec3f size = shape.hi() - shape.lo;
  for (int i = 0; i < 8; i++) {
    const Vec3f place = shape.lo + size * random_colour(random);
    lamps.push_back({place, (random_colour(random) + Vec3f::filled(0.1f)) * dot(size, size) * 0.1f});
  }
  LightGrid grid;
  grid.shape = shape;
  grid.valid.assign(shape.count(), 1);
  for (size_t i = 0; i < shape.count(); i++) {
    const Vec3i n = shape.node(i);
    Moments m = uniform_light({{0.2f, 0.15f, 0.1f}});
    for (const Bulb& lamp : lamps) {
      const Vec3f to = lamp.place - shape.position(n);
      const float fluctuation = std::max(0.0f, 1 + noise * 1.732f * (2 * random.uniform() - 1));
      m += parallel_light(normalized(to), lamp.power * (fluctuation / (dot(to, to) + 0.02f * dot(size, size))));
    }
    grid.moments.push_back(m);
    if (solids && (n[0] / 3 + 2 * (n[1] / 3) + 5 * (n[2] / 3)) % 10 == 7) grid.valid[i] = 0;
  }
  return grid;
}

/// A shape of 2 ... 2 + extra nodes an axis with uneven cells, away from the origin.
inline GridShape random_shape(Random& random, uint32_t extra) {
  GridShape shape;
  for (int a = 0; a < 3; a++) {
    shape.nodes[a] = static_cast<int>(2 + random.below(extra + 1));
    shape.cell[a] = 0.05f + random.uniform();
    shape.lo[a] = 10 * random.uniform() - 5;
  }
  return shape;
}

}  // namespace lightwell
