// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// Cuts a polygon of n points, nearly planar, into n - 2 triangles and appends them, as indices into `points`, with the
/// polygon's winding. A concave polygon is cut by ear clipping (Meisters, Polygons Have Ears, American Mathematical
/// Monthly 1975); one of more than 256 corners is treated as convex, since clipping takes n^2 steps. Fewer than three
/// points give nothing.
void triangulate(std::span<const Vec3f> points, std::vector<Face>& triangles);

}  // namespace lightwell
