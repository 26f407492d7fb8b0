// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// A position farther out than this (in the file's unit) is refused: products of edges would leave a float's range.
constexpr float farthest_position = 1e9f;

/// Takes out the vertices of no face, the others keep their order. Returns how many there were.
size_t drop_unused_vertices(Mesh& mesh);

/// Gives every vertex a unit normal: the mesh's own where it has one of some length, else the smooth one.
void complete_normals(Mesh& mesh);

}  // namespace lightwell
