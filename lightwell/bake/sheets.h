// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/free_space.h"

namespace lightwell {

/// True when a surface is a sheet at the place of a hit: a wall without thickness that is seen from both sides, with
/// free space before and behind it. `direction` is that of the ray that hit it.
bool is_sheet(const TraceScene& scene, const FreeSpace& space, const Hit& hit, const Vec3f& direction, Random& random);

/// Of a cell: how far off a node both sides of a sheet may be. Lookups are moved off surfaces by more.
constexpr float near_sheet = 0.2f;

/// True for a node that lies on a sheet, or on a wall that is hardly thicker, which stands across the axis of the grid,
/// with free space on both sides. The node is of neither; where it is invalid it keeps them apart, as a node inside a
/// thin wall does (docs/decisions/010-thin-walls.md).
bool is_on_sheet(const TraceScene& scene, const FreeSpace& space, const Vec3f& node, const Vec3f& cell, int axis,
                 Random& random);

}  // namespace lightwell
