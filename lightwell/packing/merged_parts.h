// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lightwell/packing/parts_file.h"
#include "lightwell/scene/client_lamp.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// The last mesh of a document, shown by its last node: in scene space, a primitive a kind of parts.
struct MergedMesh {
  std::vector<uint32_t> part_of_vertex;
  float part_size = 0;  ///< what has 14 bits: the longest side of its largest part, at most 16 times that of the least
};

/// The parts of a scene that were merged.
struct MergedParts {
  PartsFile file;                  ///< with empty tables
  size_t first_primitive = 0;      ///< of Scene::primitives that is one of them
  std::vector<MergedMesh> meshes;  ///< of that primitive and those behind it
};

/// Merges the parts of scene and document that mergeable_parts() finds: static nodes and meshes that hold nothing else
/// leave the document for a PartsFile. What stays keeps its order, and lamps name it by its new number. `lost` gets the
/// names of attributes that go.
std::optional<MergedParts> merge_parts(Scene& scene, std::vector<ClientLamp>& lamps, std::set<std::string>& lost);

}  // namespace lightwell
