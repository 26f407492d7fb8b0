// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "lightwell/base/vector.h"

namespace lightwell {

/// A colour for each of many cells, once filled only read: open addressing in one array, an entry within a line of
/// memory, for which can be asked before it is needed. Gathering looks up a cell in another place of memory for each
/// ray, and waited for it a quarter of its time.
class CellTable {
 public:
  /// Keys of cells differ in few bits.
  struct Mixed {
    size_t operator()(uint64_t cell) const {
      cell *= 0x9e3779b97f4a7c15;
      return cell ^ cell >> 32;
    }
  };

  /// For at most so many cells.
  explicit CellTable(size_t cells = 0) : entries_(std::bit_ceil(2 * cells + 1)) {}

  /// Adds a cell that is not there yet; keys are not 0.
  void add(uint64_t cell, const Vec3f& colour) {
    size_t i = first(cell);
    while (entries_[i].cell != 0) i = next(i);
    entries_[i] = {cell, colour};
  }
  size_t bytes() const { return entries_.capacity() * sizeof(Entry); }
  /// nullptr: it is not there.
  const Vec3f* find(uint64_t cell) const {
    for (size_t i = first(cell); entries_[i].cell != 0; i = next(i))
      if (entries_[i].cell == cell) return &entries_[i].colour;
    return nullptr;
  }
  /// Asks the memory for what find() will look at. (GCC takes a function that only prefetches for one that does
  /// nothing, and leaves out its calls, unless it must inline it.)
  [[gnu::always_inline]] void prefetch(uint64_t cell) const { __builtin_prefetch(&entries_[first(cell)]); }

 private:
  struct alignas(32) Entry {
    uint64_t cell = 0;
    Vec3f colour{};
  };

  size_t first(uint64_t cell) const { return Mixed()(cell) & (entries_.size() - 1); }
  size_t next(size_t i) const { return (i + 1) & (entries_.size() - 1); }

  std::vector<Entry> entries_;
};

}  // namespace lightwell
