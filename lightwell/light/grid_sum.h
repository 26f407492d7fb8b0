// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/light/grid.h"

namespace lightwell {

/// Adds the light of a grid of the same cells and valid nodes: light is additive.
void add_light(LightGrid& sum, const LightGrid& more);

/// Multiplies the light of a grid by a factor for each colour.
void scale_light(LightGrid& grid, const Vec3f& factor);

}  // namespace lightwell
