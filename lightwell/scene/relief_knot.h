// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// A carved stone in the shape of a trefoil knot: a closed tube of 2 * along * around triangles with smooth normals,
/// round the origin in the plane z = 0, 2.9 m wide, 2.7 m tall and 1.4 m deep. Its relief has every scale from the
/// twisted flutes down to what the triangles can carry: ridges 2 cm apart and a millimetre high at a million triangles.
/// `seed` chooses the relief.
Mesh relief_knot(uint32_t along, uint32_t around, uint64_t seed);

}  // namespace lightwell
