// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <new>

#include "lightwell/client/heap.h"

// Makes the standard libraries trap on fatal errors. By default they print a message, which would bring in printf and
// the only functions that the module would have to import.

_LIBCPP_BEGIN_NAMESPACE_STD
void __libcpp_verbose_abort(const char*, ...) { __builtin_trap(); }
_LIBCPP_END_NAMESPACE_STD

extern "C" void __cxa_pure_virtual() { __builtin_trap(); }

extern "C" void abort() { __builtin_trap(); }

// The module never ends: what is static is not destroyed.
extern "C" int __cxa_atexit(void (*)(void*), void*, void*) { return 0; }

namespace {

void* grow(std::size_t bytes) {
  const std::size_t before = __builtin_wasm_memory_grow(0, bytes / lightwell::Heap::page);
  return before == static_cast<std::size_t>(-1) ? nullptr : reinterpret_cast<void*>(before * lightwell::Heap::page);
}

constinit lightwell::Heap heap(grow);

}  // namespace

void* operator new(std::size_t size) {
  if (void* memory = heap.allocate(size)) return memory;
  __builtin_trap();
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return heap.allocate(size); }
void operator delete(void* memory) noexcept { heap.release(memory); }
void operator delete[](void* memory) noexcept { heap.release(memory); }
void operator delete(void* memory, std::size_t) noexcept { heap.release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { heap.release(memory); }

// WebAssembly has instructions for these, to which the builtins compile; the C library was built without them.
extern "C" void* memcpy(void* to, const void* from, std::size_t size) { return __builtin_memcpy(to, from, size); }
extern "C" void* memmove(void* to, const void* from, std::size_t size) { return __builtin_memmove(to, from, size); }
extern "C" void* memset(void* to, int value, std::size_t size) { return __builtin_memset(to, value, size); }
