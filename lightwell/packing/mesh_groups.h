// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/mesh/mesh.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// The primitives, by their numbers in the scene, that one stream refines: each a region of it.
using MeshGroup = std::vector<int>;

/// Puts the primitives that have faces and do not deform into groups, in their order. Together are those of one mesh
/// with the same attributes that touch, so that no crack opens between them at any level, and of the others those of
/// few vertices, since a stream and arrays for each would take more bytes than what they say. Alone stays what is so
/// small beside its group that the lattice they share would change its form.
std::vector<MeshGroup> mesh_groups(const Scene& scene);

/// The meshes of a group as one, and of each of its vertices the region.
struct UnitedMesh {
  Mesh mesh;
  std::vector<uint16_t> region_of_vertex;
};
UnitedMesh united(const Scene& scene, const MeshGroup& group);

}  // namespace lightwell
