// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// Cuts a polygon of n points, nearly plane, into n - 2 triangles and appends them, as indices into `points`, with the
/// polygon's winding. A polygon with dents is cut by clipping ears (Meisters 1975); one of more than 256 corners is
/// taken as convex, since clipping takes n^2 steps. Fewer than three points give nothing.
void triangulate(std::span<const Vec3f> points, std::vector<Face>& triangles);

}  // namespace lightwell
