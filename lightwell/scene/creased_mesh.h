// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// Triangles without shared vertices (three corners each) as a mesh: corners at one position share a vertex unless an
/// edge sharper than 40 degrees or another colour lies between them. `colors` are those of the triangles, or empty.
/// Triangles without area are left out.
Mesh creased_mesh(const std::vector<Vec3f>& corners, const std::vector<Vec4f>& colors);

}  // namespace lightwell
