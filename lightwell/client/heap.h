// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lightwell {

/// The memory of the WebAssembly module, in a tenth of the bytes of the C library's allocator, which a page has to wait
/// for (docs/decisions/008-size-of-the-page.md). Free blocks are kept in the order of their addresses and joined where
/// they touch (B. Kernighan and D. Ritchie, The C Programming Language, section 8.7); small ones by their size, so that
/// the list of the others is short. For one thread.
class Heap {
 public:
  /// Adds `bytes`, a multiple of `page`, behind all memory before, as WebAssembly's memory.grow does; null when there
  /// is no more.
  using Grow = void* (*)(size_t bytes);
  static constexpr size_t page = 65536, alignment = 16;

  explicit constexpr Heap(Grow grow) : grow_(grow) {}

  /// Memory for `size` bytes; null when there is no more.
  void* allocate(size_t size);
  /// Takes back what allocate() returned; null is nothing.
  void release(void* memory);

 private:
  /// In front of each block; its size counts this in.
  struct alignas(alignment) Block {
    size_t size = 0;
    Block* next = nullptr;  // the next free one
  };
  static constexpr size_t most_small = 256;

  Block* take(size_t size);
  void put(Block* block);

  Grow grow_;
  std::array<Block*, most_small / alignment + 1> small_{};  // free ones of each size
  Block* first_ = nullptr;                                  // of the larger free ones
};

}  // namespace lightwell
