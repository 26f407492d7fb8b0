// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/packing/pack_options.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// A primitive whose finer levels are streamed.
struct StreamedMesh {
  int primitive = 0;  ///< of the scene
  EncodedMesh encoded;
};

/// Orders and encodes the meshes of a scene that the opening does not hold whole, by falling error of their coarsest
/// level as it is seen in the scene (metres; the largest instance counts).
Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, const PackOptions& options, Progress& progress);

}  // namespace lightwell
