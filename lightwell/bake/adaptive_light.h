// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>

#include "lightwell/bake/estimator.h"
#include "lightwell/bake/gathered_light.h"
#include "lightwell/bake/light_error.h"
#include "lightwell/base/progress.h"

namespace lightwell {

/// When an adaptive grid is fine enough, and how it is looked up meanwhile.
struct RefinementOptions {
  float target_error = 0;   ///< mean error, a share of the mean irradiance
  size_t most_nodes = 0;    ///< about
  float most_insides = 1;   ///< see AdaptiveLight::grid
  float normal_offset = 0;  ///< see LightGrid
};

/// The light of a grid's own nodes and of the nodes of bricks, gathered one by one as the grid is divided.
class AdaptiveLight {
 public:
  /// `light` must outlive this; `nodes` is the light of the grid's own nodes.
  AdaptiveLight(const GatheredLight& light, const GridShape& shape, NodeLight nodes, const EstimatorOptions& options)
      : light_(light), shape_(shape), nodes_(std::move(nodes)), options_(options), tree_(shape.cells()) {}

  /// Adds bricks where the grid errs most at `points`. The same for any number of threads. Fails when `progress` asks
  /// to stop.
  Result<void> refine(const TestPoints& points, const RefinementOptions& options, Progress& progress);

  /// The grid of which nodes with at most so large a share of insides around them are valid.
  LightGrid grid(float most_insides) const;

  /// The number of nodes.
  size_t count() const { return shape_.count() + brick_nodes_; }
  uint64_t rays() const { return nodes_.rays; }

 private:
  struct Node {
    Moments moments;
    float insides = 0;
  };

  std::vector<Brick> worst_bricks(const TestPoints& points, const LightGrid& grid, size_t count) const;
  Result<bool> divide(const std::vector<Brick>& bricks, Progress& progress);

  const GatheredLight& light_;
  GridShape shape_;
  NodeLight nodes_;
  EstimatorOptions options_;
  BrickTree tree_;
  std::unordered_map<uint64_t, Node> gathered_;  // nodes of bricks, by their place
  size_t brick_nodes_ = 0;
};

}  // namespace lightwell
