// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>
#include <vector>

#include "lightwell/bake/node_surroundings.h"
#include "lightwell/light/grid.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// The number of a place of a lattice: a corner of cells of a level, counted from the grid's first node. A corner that
/// coarser cells have too is that of the coarsest.
uint64_t lattice_place(int level, Vec3i corner);

/// Tells which nodes the lookups of a scene's surfaces reach through walls: nodes under a floor that is a sheet, or in
/// the next room. Where most do, the node had better be left out, whatever is known of solids and sheets.
class LookupSides {
 public:
  /// Takes `count` points of the fronts of what lies in a box, and those of the backs of what has two sides, which
  /// count less: they are seldom what is looked at. The scene must outlive this.
  LookupSides(const TraceScene& scene, const Box3f& box, size_t count = 20'000, uint64_t seed = 0x51de);

  /// Follows the points' lookups in a grid of these cells, shifted by up to a quarter of a cell, as a good grid has it.
  void follow(const GridShape& shape, const BrickTree& tree, int threads);
  /// The normals of the points whose lookups reach a node most.
  Facings facings(uint64_t place) const;
  /// The weight of the lookups that reach a node without a surface between, less that of those that do so through one.
  float balance(uint64_t place) const;
  /// Whether more of the lookups' weight reaches a node through surfaces than without; false where none reaches it.
  bool across(uint64_t place) const { return balance(place) < 0; }

 private:
  struct Point {
    Vec3f position{}, normal{};
    float weight = 1;
  };

  const TraceScene& scene_;
  std::vector<Point> points_;
  struct Reached {
    float balance = 0;  // weight that reaches a node without a wall, less that through walls
    Facings facings{};
  };
  std::unordered_map<uint64_t, Reached> reached_;
};

}  // namespace lightwell
