// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// The mesh of a primitive as a message names it: by its name in the document, quoted, or by its number.
inline std::string mesh_name(const Scene& scene, const Primitive& primitive) {
  if (primitive.source_mesh < 0) return "a mesh";
  const Json& mesh = scene.document.json["meshes"][static_cast<size_t>(primitive.source_mesh)];
  if (mesh.contains("name") && mesh["name"].is_string()) return '"' + mesh["name"].get<std::string>() + '"';
  return "mesh " + std::to_string(primitive.source_mesh);
}

}  // namespace lightwell
