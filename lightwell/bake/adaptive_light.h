// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <unordered_map>

#include "lightwell/bake/estimator.h"
#include "lightwell/bake/gathered_light.h"
#include "lightwell/bake/light_error.h"
#include "lightwell/base/progress.h"

namespace lightwell {

/// When an adaptive grid is fine enough.
struct RefinementOptions {
  float target_error = 0;  ///< root mean square, a share of the mean irradiance
  size_t most_bytes = 0;   ///< of its stream
  float most_insides = 1;  ///< see AdaptiveLight::grid
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

/// Why an adaptive grid was divided no further.
enum class Refinement { to_target, to_budget, to_finest, to_deadline };

/// The light of a grid's own nodes and of the nodes of bricks, gathered one by one as the grid is divided.
class AdaptiveLight {
 public:
  /// `light` must outlive this; `nodes` is the light of the grid's own nodes.
  AdaptiveLight(const GatheredLight& light, const GridShape& shape, NodeLight nodes, int threads)
      : light_(light),
        shape_(shape),
        nodes_(std::move(nodes)),
        threads_(threads),
        tree_(shape.cells()),
        brick_nodes_(tree_) {}

  /// Adds bricks where the grid errs most at `points`. The same for any number of threads, unless the deadline ends it.
  /// Fails when `progress` asks to stop.
  Result<Refinement> refine(const TestPoints& points, const RefinementOptions& options, Progress& progress);

  /// The grid of which nodes with at most so large a share of insides around them are valid.
  LightGrid grid(float most_insides) const;

  /// A grid of the cells and valid nodes of another one, in another light: `nodes` is that of the grid's own nodes.
  /// Fails when `progress` asks to stop.
  static Result<LightGrid> relit(const LightGrid& like, const GatheredLight& light, NodeLight nodes, int threads,
                                 Progress& progress);

  /// The number of nodes.
  size_t count() const { return shape_.count() + brick_nodes_.nodes().size(); }
  uint64_t rays() const { return nodes_.rays; }

 private:
  struct Node {
    Moments moments;
    float insides = 0;
    float noise = 0;  // see NodeSurroundings
  };

  std::vector<Brick> worst_bricks(const TestPoints& points, const LightGrid& grid, size_t count) const;
  Result<void> divide(const std::vector<Brick>& bricks, Progress& progress);
  void keep_within(const RefinementOptions& options);

  const GatheredLight& light_;
  GridShape shape_;
  NodeLight nodes_;
  int threads_;
  BrickTree tree_;
  BrickNodes brick_nodes_;
  std::unordered_map<uint64_t, Node> gathered_;  // nodes of bricks, by their place
};

}  // namespace lightwell
