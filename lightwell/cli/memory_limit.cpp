// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <new>

#include "lightwell/cli/number_text.h"

namespace lightwell {
namespace {

// Measured: of 871,414 faces of a scan 180 MB are needed, of 1,200,000 in 100,000 boxes 700 MB.
constexpr uint64_t bytes_of_mesh_face = 100;  // Embree's tree, the order of progressive transmission
constexpr uint64_t bytes_of_instance = 1024;
// The surface cache and the nodes; measured are 15 MB (a glass table) to 220 (a room of many small things).
constexpr uint64_t bytes_of_light = 180 << 20;

/// For the undoing of what was begun when memory ended: destructors of JSON allocate a list of what they destroy, and
/// may not fail.
constexpr size_t reserve_bytes = size_t(8) << 20;
std::atomic<void*> reserve = nullptr;

void give_the_reserve() {
  std::free(reserve.exchange(nullptr));
  std::set_new_handler(nullptr);
  throw std::bad_alloc();
}

/// Says why the program ends: what a library did not catch, or could not, such as threads that cannot be started.
[[noreturn]] void end_in_words() {
  const char* reason = memory_has_ended;
  const std::exception_ptr exception = std::current_exception();
  try {
    if (exception) std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
  } catch (const std::exception& other) {
    reason = other.what();
  } catch (...) {
  }
  std::fprintf(stderr, "lightwell: %s\n", reason);
  std::_Exit(1);
}

}  // namespace

uint64_t machine_memory() {
  uint64_t bytes = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
  for (const char* name : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    uint64_t of_container = 0;
    if (std::ifstream(name) >> of_container) bytes = std::min(bytes, of_container);  // "max" is no number
  }
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) == 0) bytes = std::min<uint64_t>(bytes, limit.rlim_cur);
  }
  return bytes;
}

uint64_t least_memory(const Scene& scene) {
  uint64_t bytes = bytes_of_instance * scene.instances.size();
  for (const Primitive& primitive : scene.primitives) bytes += bytes_of_mesh_face * primitive.mesh.faces.size();
  return bytes;
}

uint64_t expected_memory(const Scene& scene, uint64_t already) {
  return already + bytes_of_light + least_memory(scene);
}

Result<void> check_memory(const Scene& scene, uint64_t limit) {
  const uint64_t least = least_memory(scene);
  if (least <= limit) return {};
  return fail(ErrorKind::limit, "memory",
              "at least " + size_text(least) + " are needed, and " + size_text(limit) +
                  " are there; --memory-limit sets another limit");
}

void limit_memory(uint64_t bytes) {
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, bytes);
  ::setrlimit(RLIMIT_DATA, &limit);
}

void prepare_for_the_end_of_memory() {
  reserve = std::malloc(reserve_bytes);
  std::set_new_handler(give_the_reserve);
  std::set_terminate(end_in_words);
}

}  // namespace lightwell
