// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/brick_regions.h"

#include <algorithm>
#include <array>
#include <span>

namespace lightwell {
namespace {

/// A brick of level 1.
struct Root {
  Vec3i at{};
  uint32_t bricks = 0;  // itself and those within
  uint32_t region = 0;
};

Vec3i root_of(const Brick& brick) {
  const int shift = brick.level - 1;
  return {{brick.at[0] >> shift, brick.at[1] >> shift, brick.at[2] >> shift}};
}

/// A place between bricks of level 1: those of less than `at` on an axis lie before it.
struct Plane {
  int axis = 0, at = 0;
};

/// The plane that halves a region's bricks: across the axis on which they lie farthest apart. One beyond all of them
/// where they do not.
Plane halving(std::span<const Root> roots, uint32_t region) {
  constexpr int most_places = 128;
  Vec3i lo = Vec3i::filled(most_places), hi{};
  uint32_t all = 0;
  for (const Root& root : roots) {
    if (root.region != region) continue;
    lo = min(lo, root.at);
    hi = max(hi, root.at);
    all += root.bricks;
  }
  if (all == 0) return {};
  const Vec3i size = hi - lo;
  const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
  std::array<uint32_t, most_places> at_place{};
  for (const Root& root : roots)
    if (root.region == region) at_place[static_cast<size_t>(root.at[axis])] += root.bricks;
  Plane plane{axis, lo[axis]};
  uint32_t before = 0;
  do before += at_place[static_cast<size_t>(plane.at++)];
  while (2 * before < all && plane.at < hi[axis]);
  return plane;
}

}  // namespace

BrickRegions BrickRegions::split(const BrickTree& ordered, int halvings) {
  BrickRegions split{.tree = BrickTree(ordered.cells()), .regions = {}};
  std::vector<Root> roots;
  std::vector<uint32_t> root_of_brick;
  for (const Brick& brick : ordered.bricks()) {
    if (brick.level == 1) roots.push_back({.at = brick.at});
    root_of_brick.push_back(*ordered.find({.level = 1, .at = root_of(brick)}));
    roots[root_of_brick.back()].bricks++;
  }
  uint32_t count = 1;
  for (int i = 0; i < halvings; i++, count *= 2) {
    std::vector<Plane> planes;
    for (uint32_t region = 0; region < count; region++) planes.push_back(halving(roots, region));
    for (Root& root : roots) {
      const Plane& plane = planes[root.region];
      root.region = 2 * root.region + (root.at[plane.axis] >= plane.at);
    }
  }
  for (uint32_t number = 0; number < count; number++) {
    BrickRegion region{.begin = static_cast<uint32_t>(split.tree.bricks().size()), .lo = ordered.cells(), .hi = {}};
    for (size_t brick = 0; brick < root_of_brick.size(); brick++) {
      const Root& root = roots[root_of_brick[brick]];
      if (root.region != number) continue;
      split.tree.add(ordered.bricks()[brick]);
      region.lo = min(region.lo, root.at * 2);
      region.hi = max(region.hi, root.at * 2 + Vec3i::filled(2));
    }
    region.end = static_cast<uint32_t>(split.tree.bricks().size());
    if (region.count() > 0) split.regions.push_back(region);
  }
  return split;
}

}  // namespace lightwell
