// SPDX-License-Identifier: Apache-2.0
//
// The points of bricks: which are nodes, and how the others follow from coarser cells.
#include <bit>

#include "lightwell/base/assert.h"
#include "lightwell/light/grid.h"

namespace lightwell {
namespace {

/// The axes on which a point lies between the corners of coarser cells, as bits.
int axes_between(const Vec3i& local) { return (local[0] & 1) | (local[1] & 1) << 1 | (local[2] & 1) << 2; }

/// The light of coarser cells around a brick.
class Coarser {
 public:
  Coarser(const LightGrid& grid, const Brick& brick) : grid_(grid) {
    if (brick.level == 1) {
      first_ = brick.at * 2;
      return;
    }
    const Vec3i at{{brick.at[0] >> 1, brick.at[1] >> 1, brick.at[2] >> 1}};
    const auto around = grid.tree.find({brick.level - 1, at});
    LW_ASSERT(around);
    points_ = &grid.bricks[*around];
    first_ = brick.at * 2 - at * Brick::cells;
  }

  /// At a point of the brick that is one of their corners.
  BrickPoint at(const Vec3i& local) const {
    const Vec3i corner = first_ + Vec3i{{local[0] / 2, local[1] / 2, local[2] / 2}};
    if (points_ != nullptr) return (*points_)[static_cast<size_t>(Brick::point(corner))];
    const size_t node = grid_.shape.index(corner);
    return {grid_.moments[node], node_weight(grid_.valid[node])};
  }

 private:
  const LightGrid& grid_;
  const BrickPoints* points_ = nullptr;  // of the brick around; without one the grid's own nodes
  Vec3i first_{};                        // the first corner among them
};

/// Which points on a brick's border hang: those that lie on the border of a coarser cell, too, since one of the bricks
/// of its level that would touch them is not there.
class HangingPoints {
 public:
  HangingPoints(const BrickTree& tree, const Brick& brick) {
    const Vec3i count = (tree.cells() * (1 << brick.level)) / Vec3i::filled(Brick::cells);
    std::array<bool, sides> missing{};
    for (int side = 0; side < sides; side++) {
      const Brick neighbour{.level = brick.level, .at = brick.at + step(side)};
      const Vec3i& at = neighbour.at;
      const bool within = min(at, Vec3i{}) == Vec3i{} && max(at, count - Vec3i::filled(1)) == count - Vec3i::filled(1);
      missing[static_cast<size_t>(side)] = within && !tree.find(neighbour);
    }
    for (int side = 0; side < sides; side++)
      for (int other = 0; other < sides; other++)
        if (touches(step(side), step(other)) && missing[static_cast<size_t>(other)])
          hanging_[static_cast<size_t>(side)] = true;
  }

  bool at(const Vec3i& local) const {
    Vec3i side;
    for (int a = 0; a < 3; a++) side[a] = (local[a] == Brick::cells) - (local[a] == 0);
    return hanging_[static_cast<size_t>(side[0] + 1 + 3 * (side[1] + 1) + 9 * (side[2] + 1))];
  }

 private:
  static constexpr int sides = 27;  // a brick's faces, edges and corners, and its middle
  static Vec3i step(int side) { return {{side % 3 - 1, side / 3 % 3 - 1, side / 9 - 1}}; }
  /// Whether the neighbour on one side touches what lies on another one.
  static bool touches(const Vec3i& side, const Vec3i& neighbour) {
    for (int a = 0; a < 3; a++)
      if (neighbour[a] != 0 && neighbour[a] != side[a]) return false;
    return true;
  }

  std::array<bool, sides> hanging_{};
};

/// The mean of the two points beside a finer point, as a lookup half-way between them finds it.
BrickPoint between(const BrickPoints& points, const Vec3i& local) {
  int axis = 0;
  while (local[axis] % 2 == 0) axis++;
  Vec3i before = local, after = local;
  before[axis]--;
  after[axis]++;
  const BrickPoint& a = points[static_cast<size_t>(Brick::point(before))];
  const BrickPoint& b = points[static_cast<size_t>(Brick::point(after))];
  BrickPoint mean{.moments = a.moments * (a.weight / (a.weight + b.weight)), .weight = (a.weight + b.weight) / 2};
  mean.moments += b.moments * (b.weight / (a.weight + b.weight));
  return mean;
}

}  // namespace

std::vector<int> finer_points() {
  std::vector<int> points;
  for (int axes = 1; axes <= 3; axes++)
    for (int point = 0; point < Brick::points; point++)
      if (std::popcount(static_cast<unsigned>(axes_between(Brick::local(point)))) == axes) points.push_back(point);
  return points;
}

void place_brick(LightGrid& grid, uint32_t brick, const BrickPoints& nodes) {
  const Coarser coarser(grid, grid.tree.bricks()[brick]);
  BrickPoints& points = grid.bricks[brick];
  points = nodes;
  for (int point = 0; point < Brick::points; point++) {
    const Vec3i local = Brick::local(point);
    if (axes_between(local) == 0) points[static_cast<size_t>(point)] = coarser.at(local);
  }
  // What is between on two axes comes after what is between on one.
  const HangingPoints hanging(grid.tree, grid.tree.bricks()[brick]);
  for (const int point : finer_points()) {
    const Vec3i local = Brick::local(point);
    if (hanging.at(local)) points[static_cast<size_t>(point)] = between(points, local);
  }
}

namespace {

/// The first brick of a region that has a corner of a level's cells, and its point there.
BrickNode first_at(const BrickTree& tree, const BrickRegion& region, int level, const Vec3i& corner) {
  BrickNode first{~uint32_t(0), 0};
  for (int side = 0; side < 8; side++) {
    Brick brick{.level = level, .at = {}};
    bool touches = true;
    for (int a = 0; a < 3; a++) {
      const bool before = (side >> a & 1) != 0;
      touches = touches && (!before || corner[a] % Brick::cells == 0);
      brick.at[a] = (corner[a] >> 2) - before;
    }
    const auto found = touches ? tree.find(brick) : std::nullopt;
    const bool within = found && *found >= region.begin && *found < region.end;
    if (within && *found < first.brick) first = {*found, Brick::point(corner - brick.at * Brick::cells)};
  }
  return first;
}

}  // namespace

BrickNodes::BrickNodes(const BrickTree& tree)
    : BrickNodes(tree, std::array{BrickRegion{.begin = 0, .end = static_cast<uint32_t>(tree.bricks().size())}}) {}

BrickNodes::BrickNodes(const BrickTree& tree, std::span<const BrickRegion> regions) : numbers_(tree.bricks().size()) {
  for (const BrickRegion& region : regions) number(tree, region);
  first_.push_back(static_cast<uint32_t>(nodes_.size()));
}

void BrickNodes::number(const BrickTree& tree, const BrickRegion& region) {
  const std::vector<int> finer = finer_points();
  for (uint32_t brick = region.begin; brick < region.end; brick++) {
    const Brick& cube = tree.bricks()[brick];
    first_.push_back(static_cast<uint32_t>(nodes_.size()));
    numbers_[brick].fill(none);
    const HangingPoints hanging(tree, cube);
    for (const int point : finer) {
      if (hanging.at(Brick::local(point))) continue;
      const BrickNode first = first_at(tree, region, cube.level, cube.corner(point));
      uint32_t& number = numbers_[brick][static_cast<size_t>(point)];
      if (first.brick < brick) {
        number = numbers_[first.brick][static_cast<size_t>(first.point)];
      } else {
        number = static_cast<uint32_t>(nodes_.size());
        nodes_.push_back({brick, point});
      }
    }
  }
}

}  // namespace lightwell
