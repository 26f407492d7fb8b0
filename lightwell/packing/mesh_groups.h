// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightwell/mesh/mesh.h"
#include "lightwell/scene/client_lamp.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// The primitives, by their numbers in the scene, that one stream refines: each a region of it.
using MeshGroup = std::vector<int>;

/// Puts the primitives that have faces and do not deform into groups, in their order. Together are those of one mesh
/// with the same attributes that touch, so that no crack opens between them at any level, and of the others those of
/// at most 65,536 vertices: they share arrays, which spares JSON, and the order of their errors. Alone stays what the
/// lattice of 21 bits that a group shares would move farther than `most_errors` says of each primitive of the scene;
/// what lies on others; and what a lamp names by a vertex, which is the first of its piece at every level of a mesh of
/// one primitive alone.
std::vector<MeshGroup> mesh_groups(const Scene& scene, std::span<const float> most_errors,
                                   std::span<const ClientLamp> lamps);

/// The meshes of a group as one, and of each of its vertices the region.
struct UnitedMesh {
  Mesh mesh;
  std::vector<uint16_t> region_of_vertex;
};
UnitedMesh united(const Scene& scene, const MeshGroup& group);

}  // namespace lightwell
