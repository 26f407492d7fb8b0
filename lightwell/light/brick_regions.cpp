// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/brick_regions.h"

#include <algorithm>
#include <limits>
#include <span>

namespace lightwell {
namespace {

/// A brick of level 1.
struct Root {
  Vec3i at{};
  size_t bricks = 0;  // itself and those within
  size_t region = 0;
};

Vec3i root_of(const Brick& brick) {
  const int shift = brick.level - 1;
  return {{brick.at[0] >> shift, brick.at[1] >> shift, brick.at[2] >> shift}};
}

/// The roots in order of their first bricks; `number_of` gives each brick its root.
std::vector<Root> roots_of(const BrickTree& tree, std::vector<size_t>& number_of) {
  std::vector<Root> roots;
  std::vector<size_t> root_of_brick(tree.bricks().size());
  for (uint32_t brick = 0; brick < tree.bricks().size(); brick++) {
    const Brick& cube = tree.bricks()[brick];
    if (cube.level == 1) {
      root_of_brick[brick] = roots.size();
      roots.push_back({.at = cube.at});
    }
    number_of.push_back(root_of_brick[*tree.find({.level = 1, .at = root_of(cube)})]);
    roots[number_of.back()].bricks++;
  }
  return roots;
}

int longest_axis(std::span<Root* const> roots) {
  Vec3i lo = roots.front()->at, hi = lo;
  for (const Root* root : roots) {
    lo = min(lo, root->at);
    hi = max(hi, root->at);
  }
  const Vec3i size = hi - lo;
  return size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
}

/// Numbers the regions of some roots from `next` on.
void halve(std::span<Root*> roots, int halvings, size_t& next) {
  if (halvings == 0 || roots.size() < 2) {
    for (Root* root : roots) root->region = next;
    next++;
    return;
  }
  const int axis = longest_axis(roots);
  std::stable_sort(roots.begin(), roots.end(), [&](const Root* a, const Root* b) { return a->at[axis] < b->at[axis]; });
  size_t all = 0, before = 0, count = 0;
  for (const Root* root : roots) all += root->bricks;
  while (count + 1 < roots.size() && (count == 0 || 2 * before < all)) before += roots[count++]->bricks;
  halve(roots.first(count), halvings - 1, next);
  halve(roots.subspan(count), halvings - 1, next);
}

}  // namespace

BrickRegions BrickRegions::split(const BrickTree& tree, int halvings) {
  BrickRegions split{.tree = BrickTree(tree.cells()), .regions = {}};
  if (tree.empty()) return split;
  const BrickTree ordered = tree.ordered();
  std::vector<size_t> number_of;
  std::vector<Root> roots = roots_of(ordered, number_of);
  std::vector<Root*> places;
  for (Root& root : roots) places.push_back(&root);
  size_t count = 0;
  halve(places, halvings, count);

  std::vector<std::vector<Brick>> bricks(count);
  for (size_t brick = 0; brick < number_of.size(); brick++)
    bricks[roots[number_of[brick]].region].push_back(ordered.bricks()[brick]);
  for (const std::vector<Brick>& of_region : bricks) {
    BrickRegion region{.begin = static_cast<uint32_t>(split.tree.bricks().size()),
                       .end = 0,
                       .lo = Vec3i::filled(std::numeric_limits<int>::max()),
                       .hi = {}};
    for (const Brick& brick : of_region) {
      split.tree.add(brick);
      const Vec3i at = root_of(brick) * 2;
      region.lo = min(region.lo, at);
      region.hi = max(region.hi, at + Vec3i::filled(2));
    }
    region.end = static_cast<uint32_t>(split.tree.bricks().size());
    split.regions.push_back(region);
  }
  return split;
}

}  // namespace lightwell
