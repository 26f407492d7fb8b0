// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "lightwell/bake/adaptive_light.h"
#include "lightwell/bake/estimator.h"
#include "lightwell/bake/light_groups.h"
#include "lightwell/base/progress.h"
#include "lightwell/light/light_field.h"

namespace lightwell {

/// Whether the environment's own light has grids of its own, apart from what surfaces reflect, beside which a client
/// finds that light more finely. `as_needed`: where one grid of all light, whose cells blur the shadows of small
/// things, does not come to the target within its bytes, and errs by more than what is left in a grid without it.
/// Regular grids, drafts and bakes whose time is limited then have one of all.
enum class SkyApart { never, as_needed, always };

struct LightBakeOptions {
  /// On the longest axis of a regular grid, at least 2; 0 for an adaptive grid, with bricks where the light changes
  /// quickly, which takes a method that goes node by node.
  int nodes = 0;
  /// The root mean square error that is aimed at, a share of the mean irradiance: the larger, the fewer rays are taken.
  float target_error = 0.01f;
  /// An adaptive grid is divided until it errs by less than that; how long its stream may get, in bytes, one for each
  /// group (the coarsest grid's own bytes are the least); and about how long all may take, in seconds: where that is
  /// little, it is a draft. A draft begins coarser and takes fewer rays.
  size_t most_bytes = 128 * 1024;
  double seconds = std::numeric_limits<double>::infinity();
  bool draft = false;
  const EstimatorKind* method = &estimators().front();
  /// Groups of luminaires of which each is to have grids of its own; of one or none all light is in the same ones.
  std::span<const LightGroup> groups{};
  /// Of an environment whose own light `contained` holds.
  SkyApart sky_apart = SkyApart::never;
  /// Luminaires whose straight light is shown beside the grid's: it is no part of the grid, but of what its error is a
  /// share of.
  LuminaireSet beside{};
  EstimatorOptions estimator;
};

/// A grid over a part of a scene.
struct BakedGrid {
  LightGrid grid;
  GridContents contains{};
  /// Where grids overlap, that of the highest priority is looked up.
  int priority = 0;
  /// Of all groups together: root mean square at test points of all kinds, as a share of the mean irradiance
  /// (docs/light.md section 4), and the same of each kind.
  float estimated_error = 0;
  ErrorEstimate estimate{};
  bool dark = false;  ///< next to no light of any group reaches what is seen
};

/// The grids with what they hold, in the same order.
std::vector<LightField::Layer> layers_of(std::vector<BakedGrid> grids);

struct LightBakeStatistics {
  uint64_t rays = 0;
  double seconds = 0;
  size_t nodes = 0;
  size_t invalid_nodes = 0;
  float estimated_error = 0;  ///< of the first grid
  ErrorEstimate estimate{};
  bool dark = false;
  /// Why the first grid was divided no further; nothing of a regular one.
  std::optional<Refinement> refinement;
};

/// Bakes the light of a world: into a grid over its focus, and where that is not all of the world into another one over
/// all of it, of lower priority. With groups there is such a grid of each group, all over the same nodes; with the sky
/// apart, one more of each group that has its light. Each bake
/// places the nodes, determines the free space, and lets an estimator fill in the light. The same world and options
/// give the same grids for any number of threads, unless the seconds end it. Fails when nothing shines, when the method
/// cannot fill an adaptive grid, when a grid has more nodes than a pack can hold, or when `progress` is cancelled.
Result<std::vector<BakedGrid>> bake_light(const World& world, const LightBakeOptions& options, Progress& progress,
                                          LightBakeStatistics& statistics);

}  // namespace lightwell
