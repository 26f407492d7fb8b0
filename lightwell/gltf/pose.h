// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/base/transform.h"
#include "lightwell/gltf/document.h"

namespace lightwell {

/// What bends a primitive: morph targets and a skin. Without either it is as its file has it.
struct Pose {
  std::vector<double> weights;  ///< of the morph targets, in their order; missing ones are 0
  std::vector<Transform>
      joints;  ///< of the skin, each with its inverse bind matrix: from the mesh at rest to its place
};

/// Puts a primitive's positions and normals into a pose, by the equations of glTF 2.0, sections 3.7.2.2 and 3.7.3.3.
/// `only` (null: all) are those of the primitive's `vertices` that the mesh has. Vertices without weight follow the
/// first joint. Fails where an attribute is of a type or count that it cannot have, or names a joint that is not there.
Result<void> apply_pose(const Document& document, const Json& primitive, const std::string& name, const Pose& pose,
                        size_t vertices, const std::vector<uint32_t>* only, Mesh& mesh);

/// A primitive as its file has it, without a pose, and of each of its vertices the row in the primitive's accessors.
struct MeshAtRest {
  Mesh mesh;
  std::vector<uint32_t> rows;
};

/// Reads it; errors and warnings are those of read_primitive().
Result<MeshAtRest> read_at_rest(const Document& document, int mesh, int primitive, Report& report);

/// The inverse bind matrices of a skin, one a joint; each the identity where the file has none.
Result<std::vector<Transform>> read_inverse_binds(const Document& document, int skin);

}  // namespace lightwell
