// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/bricks.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/model_coder.h"

namespace lightwell {
namespace {

/// The bricks of level 1 on each axis of a grid.
Vec3i coarsest(const Vec3i& cells) { return {{cells[0] / 2, cells[1] / 2, cells[2] / 2}}; }

/// An eighth of a brick: corner 0 ... 7, x fastest.
Brick inside(const Brick& brick, int corner) {
  return {brick.level + 1, brick.at * 2 + Vec3i{{corner & 1, corner >> 1 & 1, corner >> 2}}};
}

/// The place of the brick of a coarser level around a brick.
Vec3i ancestor(const Brick& brick, int level) {
  const int shift = brick.level - level;
  return {{brick.at[0] >> shift, brick.at[1] >> shift, brick.at[2] >> shift}};
}

size_t corner_of(const Vec3i& at) { return static_cast<size_t>((at[0] & 1) | (at[1] & 1) << 1 | (at[2] & 1) << 2); }

size_t count_of(const Vec3i& n) {
  return static_cast<size_t>(n[0]) * static_cast<size_t>(n[1]) * static_cast<size_t>(n[2]);
}

bool within(const Vec3i& at, const Vec3i& count) {
  return min(at, Vec3i{}) == Vec3i{} && max(at, count - Vec3i::filled(1)) == count - Vec3i::filled(1);
}

}  // namespace

/// Where the number of a brick within the grid stands; null when the coarser brick around it is not there.
uint32_t* BrickTree::place_of(const Brick& brick) {
  const Vec3i count = coarsest(cells_), first = ancestor(brick, 1);
  uint32_t* place =
      &coarsest_[static_cast<size_t>(first[0]) +
                 static_cast<size_t>(count[0]) *
                     (static_cast<size_t>(first[1]) + static_cast<size_t>(count[1]) * static_cast<size_t>(first[2]))];
  for (int level = 2; level <= brick.level; level++) {
    if (*place == none) return nullptr;
    place = &children_[*place][corner_of(ancestor(brick, level))];
  }
  return place;
}

bool BrickTree::add(const Brick& brick) {
  if (brick.level < 1 || brick.level > Brick::finest_level) return false;
  if (!within(brick.at, coarsest(cells_) * (1 << (brick.level - 1)))) return false;
  if (coarsest_.empty()) coarsest_.assign(count_of(coarsest(cells_)), none);
  uint32_t* place = place_of(brick);
  if (place == nullptr || *place != none) return false;
  *place = static_cast<uint32_t>(bricks_.size());
  bricks_.push_back(brick);
  children_.push_back({none, none, none, none, none, none, none, none});
  levels_ = std::max(levels_, brick.level);
  return true;
}

std::optional<uint32_t> BrickTree::find(const Brick& brick) const {
  if (empty() || !within(brick.at, coarsest(cells_) * (1 << (brick.level - 1)))) return std::nullopt;
  const uint32_t* place = const_cast<BrickTree*>(this)->place_of(brick);
  if (place == nullptr || *place == none) return std::nullopt;
  return *place;
}

std::optional<uint32_t> BrickTree::finest(const Vec3f& place) const {
  std::optional<uint32_t> best;
  for (int level = 1; level <= levels_; level++) {
    const float bricks_a_cell = static_cast<float>(1 << level) / Brick::cells;
    Brick brick{.level = level, .at = {}};
    for (int a = 0; a < 3; a++) {
      const int last = (cells_[a] << level) / Brick::cells - 1;
      const float at = place[a] * bricks_a_cell;
      brick.at[a] = at > 0 ? static_cast<int>(std::min(at, static_cast<float>(last))) : 0;
    }
    const auto found = find(brick);
    if (!found) break;
    best = found;
  }
  return best;
}

template <typename Coder>
bool BrickTree::code(Coder& coder, const BrickTree* wanted, size_t most) {
  std::array<AdaptiveBit, Brick::finest_level + 1> divided;
  const auto code_brick = [&](const Brick& brick) {
    const bool there = wanted != nullptr && wanted->find(brick).has_value();
    if (!coder.bit(divided[static_cast<size_t>(brick.level)], there)) return true;
    return bricks_.size() < most && add(brick);
  };
  const Vec3i count = coarsest(cells_);
  Brick first{.level = 1, .at = {}};
  for (first.at[2] = 0; first.at[2] < count[2]; first.at[2]++)
    for (first.at[1] = 0; first.at[1] < count[1]; first.at[1]++)
      for (first.at[0] = 0; first.at[0] < count[0]; first.at[0]++)
        if (!code_brick(first)) return false;
  for (size_t i = 0; i < bricks_.size(); i++) {
    const Brick brick = bricks_[i];
    if (brick.level == Brick::finest_level) continue;
    for (int corner = 0; corner < 8; corner++)
      if (!code_brick(inside(brick, corner))) return false;
  }
  return true;
}

BrickTree BrickTree::ordered() const {
  BrickTree tree(cells_);
  ModelWriter nowhere;
  tree.code(nowhere, this, bricks_.size());
  return tree;
}

std::vector<uint8_t> BrickTree::write() const {
  BrickTree tree(cells_);
  ModelWriter writer;
  tree.code(writer, this, bricks_.size());
  return writer.finish();
}

std::optional<BrickTree> BrickTree::read(const Vec3i& cells, Bytes bytes, size_t most) {
  BrickTree tree(cells);
  ModelReader reader(bytes);
  if (!tree.code(reader, nullptr, most) || reader.overrun()) return std::nullopt;
  return tree;
}

}  // namespace lightwell
