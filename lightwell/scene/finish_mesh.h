// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// The largest coordinate that is accepted, in the file's unit: beyond it products of edges would leave a float's
/// range.
constexpr float farthest_position = 1e9f;

/// Removes the vertices that no face uses; the others keep their order. Returns how many were removed.
size_t drop_unused_vertices(Mesh& mesh);

/// Gives every vertex a unit normal: the mesh's own where it is long enough to have a direction, else the smooth one.
void complete_normals(Mesh& mesh);

}  // namespace lightwell
