// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// A mesh as a little-endian binary PLY file: positions, normals if there are any, and triangles.
std::vector<uint8_t> write_ply(const Mesh& mesh);

}  // namespace lightwell
