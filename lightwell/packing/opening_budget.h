// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightwell/mesh/progressive.h"

namespace lightwell {

/// A form in which the opening may show a mesh.
struct OpeningForm {
  uint64_t bytes = 0;  ///< that it takes, with what the JSON says of it
  float error = 0;     ///< distance from the final level
};

/// The forms of a mesh: itself, without a stream; then what 1, 2, ... rounds of its collapse leave, refined by a
/// stream. `scale` is the largest factor by which the scene stretches it; errors are in metres of the scene.
std::vector<OpeningForm> opening_forms(const Mesh& mesh, const SimplifiedMesh& simplified, float scale);

/// What all refined meshes of an opening may take together.
struct OpeningBudget {
  uint64_t bytes = 0;
  /// To give meshes with an error above `likeness` (metres) a smaller one there may be more bytes.
  uint64_t bytes_for_likeness = 0;
  float likeness = 0;

  /// 40 KB, which leave room for all else in a first request of 64 KB. For a likeness within a fiftieth of the scene's
  /// size up to 1.5 KB a mesh and 256 KB in all: scenes of many parts look like nothing with less.
  static OpeningBudget of(size_t meshes, float scene_size);
};

/// Which of its forms, finest first, each mesh gets: all together keep to the budget unless even the coarsest do not,
/// as those of hundreds of meshes. The bytes go, step by step, to the mesh of the largest error. Meshes of which a
/// stream would spare hardly anything, 1500 bytes, are whole whatever the budget.
std::vector<size_t> share_opening(const std::vector<std::vector<OpeningForm>>& meshes, const OpeningBudget& budget);

}  // namespace lightwell
