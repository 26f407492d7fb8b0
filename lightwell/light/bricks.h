// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/vector.h"

namespace lightwell {

/// A cube of 4 x 4 x 4 cells of a level. Cells of level l are 2^l times smaller than the grid's on each axis, so a
/// brick of level 1 covers 2 x 2 x 2 cells of the grid, and one of a finer level an eighth of a coarser brick.
struct Brick {
  static constexpr int cells = 4;
  static constexpr int side = cells + 1;  ///< points on an axis: the corners of its cells
  static constexpr int points = side * side * side;
  static constexpr int finest_level = 4;

  int level = 1;
  Vec3i at{};  ///< its first cell is 4 * at, counted in cells of its level from the grid's first node

  bool operator==(const Brick&) const = default;
  /// Where a point lies in the brick, 0 ... 4 on each axis; x runs fastest.
  static Vec3i local(int point) { return {{point % side, point / side % side, point / (side * side)}}; }
  /// The same counted in cells of its level from the grid's first node.
  Vec3i corner(int point) const { return at * cells + local(point); }
  static int point(const Vec3i& local) { return local[0] + side * (local[1] + side * local[2]); }
};

/// Which cells of a grid are divided into bricks: the forest of octrees of an adaptive grid.
class BrickTree {
 public:
  BrickTree() = default;
  /// `cells` is the grid's number of cells on each axis.
  explicit BrickTree(const Vec3i& cells) : cells_(cells) {}

  /// Adds a brick. Returns false, and adds nothing, when it reaches out of the grid or is there already, or when the
  /// coarser brick around it is not there.
  bool add(const Brick& brick);

  bool empty() const { return bricks_.empty(); }
  /// All bricks in the order in which they were added: coarser ones before those inside of them.
  std::span<const Brick> bricks() const { return bricks_; }
  const Vec3i& cells() const { return cells_; }
  /// The finest level of all bricks; 0 without any.
  int levels() const { return levels_; }

  std::optional<uint32_t> find(const Brick& brick) const;
  /// The finest brick that holds a place, given in cells of the grid from its first node and clamped to the grid.
  std::optional<uint32_t> finest(const Vec3f& place) const;
  /// The same bricks level by level, as write() and read() order them.
  BrickTree ordered() const;
  /// A bit for each brick that could be there, in the order of ordered(), by the range coder.
  std::vector<uint8_t> write() const;
  /// What write() gives; nothing when there would be more than `most` bricks. Safe for any bytes.
  static std::optional<BrickTree> read(const Vec3i& cells, Bytes bytes, size_t most);

 private:
  uint32_t* place_of(const Brick& brick);
  template <typename Coder>
  bool code(Coder& coder, const BrickTree* wanted, size_t most);

  Vec3i cells_{};
  std::vector<Brick> bricks_;
  static constexpr uint32_t none = ~uint32_t(0);
  std::vector<uint32_t> coarsest_;                 // the number of each brick of level 1, or none
  std::vector<std::array<uint32_t, 8>> children_;  // of each brick
  int levels_ = 0;
};

}  // namespace lightwell
