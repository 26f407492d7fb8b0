// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "lightwell/light/grid.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// Finds the links of a grid by one ray each: blocked where a surface stands between two neighbours.
class WallLinks {
 public:
  /// The scene must outlive this; `box` is that of what is baked: see viewpoint().
  WallLinks(const TraceScene& scene, const Box3f& box) : scene_(scene), box_(box) {}

  /// Traces the links of a grid of this shape and of the bricks that have been added since.
  void follow(const GridShape& shape, const BrickTree& tree, int threads);
  /// Those of a grid of the first bricks that have been followed; the links of its invalid nodes are open.
  Links of(const LightGrid& grid) const;
  /// Calls visit(a, b) for each blocked link between the places of two nodes: see lattice_place.
  void for_each_blocked(const GridShape& shape, const BrickTree& tree,
                        const std::function<void(uint64_t, uint64_t)>& visit) const;

 private:
  bool blocked(const Vec3f& node, const Vec3f& cell, int axis, uint64_t seed) const;

  const TraceScene& scene_;
  Box3f box_;
  Links links_;
};

}  // namespace lightwell
