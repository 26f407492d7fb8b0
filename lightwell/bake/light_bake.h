// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/light/grid.h"
#include "lightwell/trace/lights.h"

namespace lightwell {

struct LightBakeOptions {
  int nodes = 32;  ///< on the grid's longest axis, at least 2
  uint64_t photons = 8'000'000;
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
  /// One flag a luminaire: its direct light goes into the grid as well. Empty: only indirect light. See
  /// plan_lamps().
  std::vector<uint8_t> contained;
};

struct LightBakeStatistics {
  uint64_t photons = 0;
  uint64_t rays = 0;
  double seconds = 0;
  size_t invalid_nodes = 0;
  float escaped = 0;  ///< share of flights that left the scene
  /// The noise of the grid, as a share of its root mean square irradiance: half the difference of two half bakes
  /// (docs/light.md section 4). Says nothing of the blur by the nodes' boxes.
  float estimated_error = 0;
};

/// Traces photons through the scene and estimates the light at the nodes of a grid over its bounds from the lengths of
/// their flights through the nodes' boxes (docs/decisions/003-track-estimator.md). The same scene and options give the
/// same grid for any number of threads. Fails when nothing shines, or when `progress` asks to stop.
Result<LightGrid> bake_light(const TraceScene& scene, const LightBakeOptions& options, Progress& progress,
                             LightBakeStatistics& statistics);

}  // namespace lightwell
