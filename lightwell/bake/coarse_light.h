// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "lightwell/bake/adaptive_light.h"
#include "lightwell/bake/light_bake.h"

namespace lightwell {

/// What one grid may take.
struct Effort {
  int nodes = 0;  ///< on the longest axis, before it is divided
  bool adaptive = false;
  size_t most_bytes = 0;
  /// Of the rays that a bake takes by default: fewer where less is asked for.
  float rays = 1;
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();

  bool draft() const;
  /// The least that gives a picture.
  Effort as_draft() const;
};

/// Nodes on the longest axis of a grid that is to be divided; of a draft, and where there is little room.
constexpr int coarse_nodes = 17, coarsest_nodes = 9;
/// Less than so large a share of the usual rays shows as noise before it is measured.
constexpr float least_rays = 0.25f;

/// A share of a number of rays or points.
inline int scaled(int count, float share) { return static_cast<int>(std::lround(static_cast<float>(count) * share)); }

/// The part of a scene that grids cover.
struct Place {
  const World& world;
  const FreeSpace& space;
  Box3f box;
};

/// The light of the surfaces that the nodes of a grid see, in cells as large as `cell`, metres.
Result<SurfaceCache> light_surfaces(const Place& place, const GridShape& shape, float cell,
                                    const EstimatorOptions& options, Progress& progress);

/// The light at the nodes of a regular grid.
Result<NodeLight> light_nodes(const BakeScene& scene, const GridShape& shape, const LightBakeOptions& options,
                              Progress& progress);

/// Keeps the grid that errs least, by TestPoints::badness(), of those that it is shown.
class BestGrid {
 public:
  explicit BestGrid(const TestPoints& test) : test_(test) {}

  /// Shows it the ways to use the nodes' light. A node that sees some insides stands near a thin solid, or behind a
  /// sheet: in rooms of sheets it is better left out, among furniture it is better kept.
  /// True when one of them is the best so far, and errs at most by this share of what the best one did.
  bool consider(const AdaptiveLight& light, std::span<const NodeRule> ways = rules, float most = 1);

  const NodeRule& rule() const { return rule_; }
  size_t nodes() const { return nodes_; }
  LightGrid take() { return std::move(grid_); }

 private:
  /// The ways to use nodes that see some insides.
  static constexpr std::array<NodeRule, 8> rules = {
      {{0.25f}, {0.5f}, {0.8f}, {0.95f}, {0.25f, true}, {0.5f, true}, {0.8f, true}, {0.95f, true}}};

  const TestPoints& test_;
  LightGrid grid_;
  float badness_ = 0;
  NodeRule rule_;
  size_t nodes_ = 0;
};

/// The light of a grid that is not divided yet, what it was gathered from, and the points by which it was chosen.
class CoarseLight {
 public:
  /// Of the grids that a place could have the one that errs least. `options` and what `place` refers to must outlive
  /// it. Fails when a grid has more nodes than a pack can hold, or when `progress` is cancelled.
  static Result<std::unique_ptr<CoarseLight>> gather(const Place& place, const LightBakeOptions& options,
                                                     const Effort& effort, Progress& progress);

  /// Others depend on these by reference.
  CoarseLight(const CoarseLight&) = delete;

  const BakeScene& scene() const { return scene_; }
  const GatheredLight& light() const { return light_; }
  /// Options of points like those by which the grid was chosen.
  const TestPointOptions& testing() const { return testing_; }
  BestGrid& best() { return best_; }
  AdaptiveLight& nodes() { return *nodes_; }
  /// Of the light of surfaces, metres.
  float cell() const { return cell_; }
  uint64_t rays() const { return rays_; }

 private:
  CoarseLight(const Place& place, const LightBakeOptions& options, SurfaceCache cache, float cell);

  EstimatorOptions estimator_;
  SurfaceCache cache_;
  float cell_;
  BakeScene scene_;
  GatheredLight light_;
  std::optional<GatheredLight> beside_;  // of LightBakeOptions::beside
  TestPointOptions testing_;
  TestPoints test_;
  BestGrid best_;
  std::optional<AdaptiveLight> nodes_;
  uint64_t rays_;
};

}  // namespace lightwell
