// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/mesh/mesh.h"
#include "lightwell/scene/ply_header.h"

namespace lightwell {

/// The vertices of a PLY file and its faces, not yet cut into triangles.
struct PlyPolygons {
  std::vector<Vec3d> positions;
  Mesh attributes;                ///< what else the vertices have; without positions and faces
  std::vector<uint32_t> corners;  ///< of all faces, one after another; each is a vertex
  std::vector<size_t> ends;       ///< where each face's corners end
  /// Texture coordinates that corners have of their own, v downwards; empty when faces say none.
  std::vector<Vec2f> corner_texcoords;
  /// The number of each face's texture in the header, -1 where it has none; strips, which come last, say nothing.
  std::vector<int> textures;
};

/// Whether a property is read; those of a face's texture only where the header names textures (`textured`).
bool is_read(const PlyElement& element, const PlyProperty& property, bool textured);

/// Reads the elements that a header announces from the bytes that follow it. Errors name the vertex or face at fault.
Result<PlyPolygons> read_ply_polygons(const PlyHeader& header, Bytes data);

}  // namespace lightwell
