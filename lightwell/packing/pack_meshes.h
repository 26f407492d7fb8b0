// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/packing/pack_options.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// A primitive whose finer levels are streamed.
struct StreamedMesh {
  int primitive = 0;  ///< index into Scene::primitives
  EncodedMesh encoded;
};

/// Simplifies and encodes the meshes that the opening does not hold whole, sorted by decreasing error of their coarsest
/// level (metres, at the largest instance). Fails when cancelled or when a position is not finite.
Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, const PackOptions& options, Progress& progress);

}  // namespace lightwell
