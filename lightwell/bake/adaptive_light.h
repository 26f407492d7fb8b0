// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <unordered_map>
#include <unordered_set>

#include "lightwell/bake/estimator.h"
#include "lightwell/bake/gathered_light.h"
#include "lightwell/bake/light_error.h"
#include "lightwell/bake/lookup_sides.h"
#include "lightwell/bake/wall_links.h"
#include "lightwell/base/progress.h"

namespace lightwell {

/// Which nodes are used: those with at most so large a share of insides around them, and, if that is asked for, that
/// most lookups do not reach through walls.
struct NodeRule {
  float most_insides = 1;
  bool by_lookups = false;
};

/// When an adaptive grid is fine enough.
struct RefinementOptions {
  float target_error = 0;  ///< root mean square, a share of the mean irradiance
  size_t most_bytes = 0;   ///< of its stream
  NodeRule rule{};
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  /// Whether a grid that errs by more is of no use: as soon as that is likely its cells are divided no further.
  bool must_reach = false;
};

/// Why an adaptive grid was divided no further.
enum class Refinement { to_target, to_budget, to_finest, to_deadline, to_no_gain };

/// Why, and by which rule its nodes are used best.
struct Refined {
  Refinement end{};
  NodeRule rule;
};

/// The light of a grid's own nodes and of the nodes of bricks, gathered one by one as the grid is divided.
class AdaptiveLight {
 public:
  /// `light` must outlive this; `nodes` is the light of the grid's own nodes.
  AdaptiveLight(const GatheredLight& light, const GridShape& shape, NodeLight nodes, int threads);

  /// Adds bricks where the grid errs most at `points`, until it errs little enough at `judge`. The same for any number
  /// of threads, unless the deadline ends it. Fails when `progress` asks to stop.
  Result<Refined> refine(const TestPoints& points, const TestPoints& judge, const RefinementOptions& options,
                         Progress& progress);

  /// The grid of which the nodes of a rule are valid.
  LightGrid grid(const NodeRule& rule) const;

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
  Result<void> divide(std::span<const Brick> bricks, Progress& progress);
  Result<void> divide_until(std::span<const Brick> bricks, const RefinementOptions& options, Progress& progress);
  void follow_links();
  void keep_within(const RefinementOptions& options, const NodeRule& rule);
  LightGrid best_grid(const TestPoints& points, NodeRule& rule) const;

  bool valid(const NodeRule& rule, float insides, int level, const Vec3i& corner) const;

  const GatheredLight& light_;
  GridShape shape_;
  NodeLight nodes_;
  int threads_;
  BrickTree tree_;
  BrickNodes brick_nodes_;
  std::unordered_map<uint64_t, Node> gathered_;  // nodes of bricks, by their lattice_place()
  LookupSides sides_;
  WallLinks links_;
  std::unordered_set<uint64_t> behind_;  // nodes that a wall hides from those that lookups reach
};

}  // namespace lightwell
