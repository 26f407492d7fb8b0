// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/heap.h"

#include <new>

namespace lightwell {

void* Heap::allocate(size_t size) {
  if (size > SIZE_MAX - page - sizeof(Block)) return nullptr;
  size = (size + sizeof(Block) + alignment - 1) & ~(alignment - 1);
  Block* block = nullptr;
  if (size <= most_small && small_[size / alignment] != nullptr) {
    block = small_[size / alignment];
    small_[size / alignment] = block->next;
  } else {
    block = take(size);
  }
  return block == nullptr ? nullptr : block + 1;
}

void Heap::release(void* memory) {
  if (memory == nullptr) return;
  Block* block = static_cast<Block*>(memory) - 1;
  if (block->size > most_small) return put(block);
  block->next = small_[block->size / alignment];
  small_[block->size / alignment] = block;
}

// The end of the smallest free block that is large enough.
Heap::Block* Heap::take(size_t size) {
  while (true) {
    Block** best = nullptr;
    for (Block** link = &first_; *link != nullptr; link = &(*link)->next)
      if ((*link)->size >= size && (best == nullptr || (*link)->size < (*best)->size)) best = link;
    if (best == nullptr) {
      const size_t bytes = (size + page - 1) & ~(page - 1);
      void* memory = grow_(bytes);
      if (memory == nullptr) return nullptr;
      put(new (memory) Block{bytes, nullptr});
      continue;
    }
    Block* block = *best;
    if (block->size < size + sizeof(Block)) {
      *best = block->next;
      return block;
    }
    block->size -= size;
    return new (reinterpret_cast<uint8_t*>(block) + block->size) Block{size, nullptr};
  }
}

void Heap::put(Block* block) {
  const auto end = [](Block* of) { return reinterpret_cast<Block*>(reinterpret_cast<uint8_t*>(of) + of->size); };
  Block* before = nullptr;
  Block** link = &first_;
  for (; *link != nullptr && *link < block; link = &(*link)->next) before = *link;
  block->next = *link;
  *link = block;
  if (block->next != nullptr && end(block) == block->next) {
    block->size += block->next->size;
    block->next = block->next->next;
  }
  if (before != nullptr && end(before) == block) {
    before->size += block->size;
    before->next = block->next;
  }
}

}  // namespace lightwell
