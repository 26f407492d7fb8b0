// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/estimator.h"
#include "lightwell/base/progress.h"
#include "lightwell/light/grid.h"

namespace lightwell {

struct LightBakeOptions {
  int nodes = 32;  ///< on the grid's longest axis, at least 2
  const EstimatorKind* method = &estimators().front();
  EstimatorOptions estimator;
};

struct LightBakeStatistics {
  uint64_t rays = 0;
  double seconds = 0;
  size_t invalid_nodes = 0;
  /// The noise of the grid, as a share of its root mean square irradiance (docs/light.md section 4). Excludes the blur
  /// by the nodes' boxes.
  float estimated_error = 0;
};

/// Bakes the light of a world into a grid: places the nodes, determines the free space, and lets an estimator fill in
/// the light. The same world and options give the same grid for any number of threads. Fails when nothing shines, when
/// the grid has more nodes than a pack can hold, or when `progress` is cancelled.
Result<LightGrid> bake_light(const World& world, const LightBakeOptions& options, Progress& progress,
                             LightBakeStatistics& statistics);

}  // namespace lightwell
