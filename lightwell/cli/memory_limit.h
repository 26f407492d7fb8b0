// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lightwell/base/result.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// Bytes that this process may have: those of the machine, or fewer where a container or `ulimit -v` says so.
uint64_t machine_memory();

/// Bytes that tracing light through a scene needs at least, by the tables that grow with its faces. What is really
/// needed is up to three times as much.
uint64_t least_memory(const Scene& scene);

/// Bytes that a bake of the scene will have taken at its peak, of which `already` were taken when the scene had been
/// read. What is really taken is at most 1.3 times as much, and where the light is simple a quarter.
uint64_t expected_memory(const Scene& scene, uint64_t already);

/// Refuses a scene that needs more than `limit` bytes in any case, instead of trying for minutes.
Result<void> check_memory(const Scene& scene, uint64_t limit);

/// Lets the system give this process no more than `bytes`.
void limit_memory(uint64_t bytes);

/// Makes sure that the end of memory, wherever it comes, is told in one line and with the status 1.
void prepare_for_the_end_of_memory();

/// What is said then.
inline constexpr const char* memory_has_ended = "the memory is not enough for this";

}  // namespace lightwell
