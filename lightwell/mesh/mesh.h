// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "lightwell/base/vector.h"

namespace lightwell {

using Face = std::array<uint32_t, 3>;

/// An indexed triangle mesh. Every attribute that is present has one entry a vertex; an absent one is empty.
struct Mesh {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;                   ///< unit; absent: shade with the triangle's geometric normal
  std::array<std::vector<Vec2f>, 2> texcoords;  ///< glTF's TEXCOORD_0 and TEXCOORD_1
  std::vector<Vec4f> colors;                    ///< linear RGBA in [0, 1]
  std::vector<Face> faces;  ///< counter-clockwise seen from the front; indices below positions.size()

  Box3f bounds() const;
};

/// The mesh of some faces of another with the vertices that these use, in their order.
Mesh mesh_of_faces(const Mesh& vertices, std::vector<Face> faces);

/// The unit normal of each vertex: the sum of its faces' normals weighted by their area. A vertex without area gets +y.
std::vector<Vec3f> smooth_normals(const Mesh& mesh);

}  // namespace lightwell
