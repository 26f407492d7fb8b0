// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/heap.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

/// Memory that grows at its end, as a WebAssembly module's.
struct Memory {
  alignas(Heap::page) static inline uint8_t bytes[256 * Heap::page];
  static inline size_t used = 0, most = sizeof(bytes);

  static void* grow(size_t more) {
    if (used + more > most) return nullptr;
    used += more;
    return bytes + used - more;
  }
};

class HeapTest : public testing::Test {
 protected:
  void SetUp() override {
    Memory::used = 0;
    Memory::most = sizeof(Memory::bytes);
  }
  Heap heap_{Memory::grow};
};

struct Held {
  uint8_t* memory = nullptr;
  size_t size = 0;
  uint8_t mark = 0;

  bool intact() const {
    for (size_t i = 0; i < size; i++)
      if (memory[i] != mark) return false;
    return true;
  }
};

TEST_F(HeapTest, BlocksAreAlignedAndDoNotOverlap) {
  Random random(3, 0);
  std::vector<Held> held;
  for (int i = 0; i < 20000; i++) {
    if (held.size() < 300 && random.below(2) == 0) {
      const size_t size = random.below(8) == 0 ? random.below(60000) : random.below(400);
      Held next{static_cast<uint8_t*>(heap_.allocate(size)), size, static_cast<uint8_t>(random.below(256))};
      ASSERT_NE(next.memory, nullptr);
      EXPECT_EQ(reinterpret_cast<uintptr_t>(next.memory) % Heap::alignment, 0u);
      std::memset(next.memory, next.mark, size);
      held.push_back(next);
    } else if (!held.empty()) {
      const size_t at = random.below(static_cast<uint32_t>(held.size()));
      ASSERT_TRUE(held[at].intact());
      heap_.release(held[at].memory);
      held[at] = held.back();
      held.pop_back();
    }
  }
  for (const Held& one : held) EXPECT_TRUE(one.intact());
}

// Arrays that grow to twice their size, as a mesh's do: what they leave behind is used again.
TEST_F(HeapTest, WhatIsReleasedIsUsedAgain) {
  std::vector<void*> arrays(6);
  for (size_t size = 1000; size < 1000000; size *= 2)
    for (void*& array : arrays) {
      void* larger = heap_.allocate(size);
      ASSERT_NE(larger, nullptr);
      heap_.release(array);
      array = larger;
    }
  // 512 kB each in the end, and what they were before: no more than twice that in all.
  EXPECT_LT(Memory::used, 2 * arrays.size() * 512000);
  for (void* array : arrays) heap_.release(array);
  const size_t before = Memory::used;
  EXPECT_NE(heap_.allocate(before - 100), nullptr) << "all of it is one block again";
  EXPECT_EQ(Memory::used, before);
}

TEST_F(HeapTest, TheEndOfMemoryIsSaid) {
  Memory::most = 4 * Heap::page;
  EXPECT_EQ(heap_.allocate(5 * Heap::page), nullptr);
  EXPECT_EQ(heap_.allocate(SIZE_MAX), nullptr);
  EXPECT_EQ(heap_.allocate(SIZE_MAX - Heap::page), nullptr);
  void* memory = heap_.allocate(3 * Heap::page);
  EXPECT_NE(memory, nullptr);
  EXPECT_EQ(heap_.allocate(2 * Heap::page), nullptr);
  heap_.release(memory);
  EXPECT_NE(heap_.allocate(3 * Heap::page), nullptr);
  heap_.release(nullptr);
  EXPECT_NE(heap_.allocate(0), nullptr);
}

}  // namespace
}  // namespace lightwell
