// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "lightwell/light/grid.h"

namespace lightwell {

/// Adds radiance that comes from a unit direction `w`, times the solid angle that it stands for (docs/light.md section
/// 1).
inline void add_radiance(Moments& moments, const Vec3f& w, const Vec3f& radiance) {
  const auto sign = [&](int a) { return w[a] < 0 ? -1.0f : 1.0f; };
  const auto mixed = [&](int a, int b) { return radiance * ((sign(a) * w[b] + sign(b) * w[a]) / 2); };
  for (int a = 0; a < 3; a++) moments.m[static_cast<size_t>(2 * a + (w[a] < 0))] += radiance * std::abs(w[a]);
  moments.m[6] += mixed(0, 1);
  moments.m[7] += mixed(0, 2);
  moments.m[8] += mixed(1, 2);
}

}  // namespace lightwell
