// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/packing/deformation.h"
#include "lightwell/packing/merged_parts.h"
#include "lightwell/packing/opening_budget.h"
#include "lightwell/packing/pack_options.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// A primitive that deforms, as its file has it at rest, and what bends it.
struct DeformingMesh {
  Mesh mesh;
  Deformation deformation;
  std::vector<uint32_t> rows;  ///< of each vertex the row of the deformation; of vertices that bend alike the same one
};

/// A primitive whose finer levels are streamed.
struct StreamedMesh {
  int primitive = 0;  ///< index into Scene::primitives
  EncodedMesh encoded;
  Box3f bounds;                                        ///< of the input
  std::optional<DeformingMesh> deforming = {};         ///< with the rows of the final level's vertices
  std::optional<DeformationAccessors> accessors = {};  ///< of the deformation, once it is written
};

/// Simplifies and encodes the meshes that the opening does not hold whole, sorted by decreasing error of their coarsest
/// level (metres, at the largest instance). What deforms is taken at rest. Fails when cancelled or when a position is
/// not finite. Gives the file of merged parts their tables.
Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, std::optional<MergedParts>& merged,
                                                const OpeningBudget& budget, const PackOptions& options,
                                                Progress& progress);

}  // namespace lightwell
