// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace lightwell {

/// Number of threads that parallel_for uses when told 0: the processors this process may use.
int default_threads();

/// Calls body(begin, end, thread) for consecutive chunks of [0, count) of at most `grain` items; thread is in
/// [0, threads). Chunks are handed out in order, to whichever thread is free, so a result must not depend on which
/// thread did what. Serial where there are no threads (WebAssembly). Stops early, between chunks, when `stop` returns
/// true.
void parallel_for(size_t count, size_t grain, int threads, const std::function<void(size_t, size_t, int)>& body,
                  const std::function<bool()>& stop = {});

}  // namespace lightwell
