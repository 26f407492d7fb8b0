// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/packing/deformation.h"
#include "lightwell/packing/merged_parts.h"
#include "lightwell/packing/mesh_groups.h"
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

/// A primitive whose finer levels are streamed, or several, each a region.
struct StreamedMesh {
  MeshGroup primitives;  ///< indices into Scene::primitives
  EncodedMesh encoded;
  std::vector<Box3f> bounds;                           ///< of each primitive, at all levels
  std::optional<DeformingMesh> deforming = {};         ///< with the rows of the final level's vertices
  std::optional<DeformationAccessors> accessors = {};  ///< of the deformation, once it is written
};

/// Of each primitive of the scene how far its vertices may be moved by the lattice of a stream, in its own units.
struct PositionErrors {
  std::vector<float> wanted;  ///< what the options say, or what is usual for it, of merged parts for these
  std::vector<float> most;  ///< 16 times what is usual, which is 10 bits, so that it can share a lattice; else the same
};
PositionErrors position_errors(const Scene& scene, const std::optional<MergedParts>& merged,
                               const PackOptions& options);

/// Simplifies and encodes the meshes that the opening does not hold whole, sorted by decreasing error of their coarsest
/// level (metres, at the largest instance): each group one mesh, and what deforms. That is taken at rest. Fails when
/// cancelled or when a position is not finite. Gives the file of merged parts their tables.
Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, std::span<const MeshGroup> groups,
                                                std::span<const float> errors, std::optional<MergedParts>& merged,
                                                const OpeningBudget& budget, const PackOptions& options,
                                                Progress& progress);

}  // namespace lightwell
