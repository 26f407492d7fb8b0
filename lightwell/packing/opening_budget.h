// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightwell/mesh/progressive.h"

namespace lightwell {

/// A form of a mesh in the opening: the whole mesh, or a coarse level that a stream refines.
struct OpeningForm {
  uint64_t bytes = 0;  ///< in the opening, including its JSON
  float error = 0;     ///< distance from the final level, metres
};

/// The forms of a mesh, finest first: the whole mesh, then the levels left by 1, 2, ... rounds of collapse, each with a
/// stream. `scale` is the largest factor by which an instance stretches the mesh; it converts errors to metres.
std::vector<OpeningForm> opening_forms(const Mesh& mesh, const SimplifiedMesh& simplified, float scale);

/// The bytes that all meshes together may take in the opening.
struct OpeningBudget {
  uint64_t bytes = 0;
  /// A larger budget, available only to meshes whose error exceeds `likeness` (metres).
  uint64_t bytes_for_likeness = 0;
  float likeness = 0;

  /// `bytes` is 40 KB, which leaves room for the rest of the opening in a first request of 64 KB. `likeness` is 1/50 of
  /// `scene_size` (metres); up to it, the budget is 1.5 KB a mesh and 1.1 KB for each region beside the first, from 40
  /// to 256 KB, since scenes of many parts are unrecognisable with less.
  static OpeningBudget of(size_t meshes, size_t more_regions, float scene_size);
  /// Of a scene whose parts are merged: what `rest` bytes of the opening, an estimate, leave of that request,
  /// at least 40 KB.
  static OpeningBudget beside(uint64_t rest);
};

/// Chooses a form for each mesh and returns its index in opening_forms(). Starts from the coarsest forms and repeatedly
/// refines the mesh of the largest error while the budget allows; the coarsest forms of hundreds of meshes may exceed
/// it. Meshes that a stream would shrink by less than about 1500 bytes are stored whole regardless of the budget.
std::vector<size_t> share_opening(const std::vector<std::vector<OpeningForm>>& meshes, const OpeningBudget& budget);

}  // namespace lightwell
