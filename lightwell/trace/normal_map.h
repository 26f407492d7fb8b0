// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "lightwell/base/vector.h"

namespace lightwell {

/// A normal turned by a normal map. `texel` is the map's colour; `scale` multiplies its x and y. The tangent follows
/// the face's texture coordinates, perpendicular to the normal, and the bitangent is perpendicular to both on the side
/// against v: the convention of MikkTSpace, from corners and coordinates, so that mirrored ones come out right. The
/// normal itself where the coordinates have no direction.
Vec3f mapped_normal(const Vec3f& normal, const std::array<Vec3f, 3>& corners, const std::array<Vec2f, 3>& texcoords,
                    const Vec3f& texel, float scale);

}  // namespace lightwell
