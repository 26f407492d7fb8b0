// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// A mesh as a little-endian binary PLY file: positions, normals if there are any, and triangles. Positions are counted
/// from `origin`; unless it is zero, the file has them as doubles.
std::vector<uint8_t> write_ply(const Mesh& mesh, const Vec3d& origin = {});

}  // namespace lightwell
