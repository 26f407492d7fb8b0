// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/bricks.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/model_coder.h"

namespace lightwell {
namespace {

uint64_t key_of(const Brick& brick) {
  uint64_t key = static_cast<uint64_t>(brick.level);
  for (const int c : brick.at.e) key = key << 18 | static_cast<uint64_t>(c);
  return key;
}

/// The bricks of level 1 on each axis of a grid.
Vec3i coarsest(const Vec3i& cells) { return {{cells[0] / 2, cells[1] / 2, cells[2] / 2}}; }

Vec3i halved(const Vec3i& v) { return {{v[0] >> 1, v[1] >> 1, v[2] >> 1}}; }

/// An eighth of a brick: corner 0 ... 7, x fastest.
Brick inside(const Brick& brick, int corner) {
  return {brick.level + 1, brick.at * 2 + Vec3i{{corner & 1, corner >> 1 & 1, corner >> 2}}};
}

bool within(const Vec3i& at, const Vec3i& count) {
  return min(at, Vec3i{}) == Vec3i{} && max(at, count - Vec3i::filled(1)) == count - Vec3i::filled(1);
}

}  // namespace

bool BrickTree::add(const Brick& brick) {
  if (brick.level < 1 || brick.level > Brick::finest_level) return false;
  if (!within(brick.at, coarsest(cells_) * (1 << (brick.level - 1)))) return false;
  if (brick.level > 1 && !find({brick.level - 1, halved(brick.at)})) return false;
  if (!numbers_.emplace(key_of(brick), static_cast<uint32_t>(bricks_.size())).second) return false;
  bricks_.push_back(brick);
  levels_ = std::max(levels_, brick.level);
  return true;
}

std::optional<uint32_t> BrickTree::find(const Brick& brick) const {
  const auto found = numbers_.find(key_of(brick));
  if (found == numbers_.end()) return std::nullopt;
  return found->second;
}

std::optional<uint32_t> BrickTree::finest(const Vec3f& place) const {
  std::optional<uint32_t> best;
  for (int level = 1; level <= levels_; level++) {
    const float bricks_a_cell = static_cast<float>(1 << level) / Brick::cells;
    Brick brick{.level = level};
    for (int a = 0; a < 3; a++) {
      const int last = (cells_[a] << level) / Brick::cells - 1;
      const float at = place[a] * bricks_a_cell;
      brick.at[a] = at > 0 ? std::min(static_cast<int>(std::min(at, static_cast<float>(last))), last) : 0;
    }
    const auto found = find(brick);
    if (!found) break;
    best = found;
  }
  return best;
}

bool BrickTree::surrounds(int level, const Vec3i& corner) const {
  const Vec3i count = coarsest(cells_) * (1 << (level - 1));
  for (int side = 0; side < 8; side++) {
    Brick brick{.level = level};
    for (int a = 0; a < 3; a++) {
      const int before = (side >> a & 1) != 0 && corner[a] % Brick::cells == 0 ? 1 : 0;
      brick.at[a] = (corner[a] >> 2) - before;
    }
    if (within(brick.at, count) && !find(brick)) return false;
  }
  return true;
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
  Brick first{.level = 1};
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
