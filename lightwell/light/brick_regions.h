// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/light/bricks.h"

namespace lightwell {

/// Bricks that lie together, of all levels: those begin ... end-1 of a tree.
struct BrickRegion {
  uint32_t begin = 0, end = 0;
  Vec3i lo{}, hi{};  ///< a box of cells of the grid that holds them, hi not within

  uint32_t count() const { return end - begin; }
};

/// A tree whose bricks come region by region, and its regions: as they are streamed, so that what is in view comes
/// first. Empty regions there are not.
struct BrickRegions {
  static constexpr int most_halvings = 6;

  BrickTree tree;
  std::vector<BrickRegion> regions;

  /// Of a tree in the order of BrickTree::ordered, which regions keep. Halves space `halvings` times, so that about as
  /// many bricks lie to both sides, by planes between bricks of level 1, which keep what they hold.
  static BrickRegions split(const BrickTree& ordered, int halvings);
};

}  // namespace lightwell
