// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/vector.h"

namespace lightwell {

/// The irradiance E of a place whose light is found in two ways: the `sky`'s by rays, and what surfaces reflect in
/// cells, which blur what is smaller than they are, such as a fold. A `share` of the sky's light gets there, by rays;
/// by the same cells `share_in_cells` would. The difference is what surfaces within the cell hide more than it knows,
/// or less. They are as bright as the place itself, so that E = sky + reflected + albedo (share_in_cells - share) E:
/// exact in a hollow ball whose cells know nothing of it. Each colour by itself; never less than the sky's light alone.
/// What is whiter than 0.95, and closed, is nothing that cells can tell.
Vec3f irradiance_in_folds(const Vec3f& albedo, const Vec3f& sky, const Vec3f& reflected, const Vec3f& share_in_cells,
                          const Vec3f& share);

}  // namespace lightwell
