// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lightwell/base/vector.h"
#include "lightwell/gltf/json.h"

namespace lightwell {

/// The LIGHTWELL_progressive_mesh extension (docs/format.md): names the stream that refines a primitive.
inline constexpr const char* mesh_extension = "LIGHTWELL_progressive_mesh";

/// Accessors of what bends a refined primitive, of all vertices of its final level in the order in which its stream
/// brings them: joints and weights of a skin by their semantics, and displacements, of each morph target, by theirs.
struct DeformationAccessors {
  std::map<std::string, int> attributes;
  std::vector<std::map<std::string, int>> targets;

  bool operator==(const DeformationAccessors&) const = default;
};

/// A primitive that a stream refines, or a region of one.
struct RefinedPrimitive {
  uint32_t stream = 0;
  uint32_t region = 0;
  uint32_t vertices = 0;           ///< of the stream's final level; said of region 0 alone
  uint32_t faces = 0;              ///< of it, in this region
  Box3f bounds;                    ///< at all levels
  float error = 0;                 ///< of the coarsest level, in the mesh's own units; said of region 0 alone
  size_t mesh = 0, primitive = 0;  ///< its place in the JSON: meshes[mesh].primitives[primitive]
  std::optional<DeformationAccessors> deformation = {};

  bool operator==(const RefinedPrimitive&) const = default;
};

/// The extension's JSON, to be stored in that primitive.
Json to_json(const RefinedPrimitive& refined);

/// Reads the extension from all primitives of a pack's JSON. Invalid input yields an error naming the element.
Result<std::vector<RefinedPrimitive>> read_refined_primitives(const Json& json);

}  // namespace lightwell
