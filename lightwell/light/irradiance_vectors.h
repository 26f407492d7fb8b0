// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "lightwell/light/grid.h"

namespace lightwell {

/// The irradiance vectors of S08 and R09 (sources at LightGrid): for each axis direction and colour the integral of
/// radiance times direction over the half of all directions around it. `v[d][c]` is that of direction d (+x, -x, +y,
/// -y, +z, -z) and colour c; its component along d is E_d.
struct IrradianceVectors {
  std::array<std::array<Vec3f, 3>, 6> v{};
};

/// Vectors with these moments. Those of light from one direction are known; of other light moments tell the components
/// across an axis only together with those across another.
IrradianceVectors vectors_of(const Moments& moments);
/// The inverse; exact for any vectors (docs/decisions/002-moments.md).
Moments moments_of(const IrradianceVectors& vectors);

}  // namespace lightwell
