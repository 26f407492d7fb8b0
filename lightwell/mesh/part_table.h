// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/base/result.h"
#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// Tells of the faces of a mesh that is made of several parts which share no vertex to which part each belongs, in a
/// number for each piece of faces that vertices join, in the order of their least vertices: 0 where the piece belongs
/// to the part of the first piece that touches it (the sides of a box have no vertex in common, but places), else 1 and
/// the number of its part.
std::vector<uint32_t> part_table(const Mesh& mesh, std::span<const uint32_t> part_of_vertex);

/// The part of each face. Fails where the table is not one of this mesh and of so many parts.
Result<std::vector<uint32_t>> parts_of_faces(const Mesh& mesh, std::span<const uint32_t> table, uint32_t parts);

}  // namespace lightwell
