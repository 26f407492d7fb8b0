// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// For each vertex, one that stands for all vertices at the same position.
std::vector<uint32_t> welded_vertices(const std::vector<Vec3f>& positions);

/// For each face, the number of its connected piece of surface; pieces are counted from 0 in the order of their first
/// faces. Faces are connected by corners at the same position.
std::vector<uint32_t> connected_faces(const Mesh& mesh);

/// For each vertex, the least one that faces join it to, directly or through others. Two vertices at one position are
/// not joined by that.
std::vector<uint32_t> joined_vertices(const Mesh& mesh);

}  // namespace lightwell
