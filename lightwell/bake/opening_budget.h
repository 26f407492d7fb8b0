// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// Bytes of a vertex of the mesh in a pack's opening: its attributes as floats, colours as bytes, and its share of the
/// indices (two faces of three 16-bit indices).
uint32_t opening_bytes_per_vertex(const Mesh& mesh);

/// How many vertices of each mesh the opening may show, so that all together fit into `budget` bytes: small meshes
/// whole, and the others an equal number of bytes each, but never fewer than 24 vertices. 0 marks a mesh that goes into
/// the opening whole and needs no stream.
std::vector<uint32_t> share_opening(const std::vector<const Mesh*>& meshes, uint64_t budget);

}  // namespace lightwell
