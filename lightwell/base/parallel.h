// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace lightwell {

/// The number of threads that parallel_for uses when `threads` is 0: one for each processor.
int default_threads();

/// Calls body(begin, end, thread) for consecutive chunks of [0, count) of at most `grain` items; thread is in
/// [0, threads), and the calling thread is number 0. Chunks are handed out in order, to whichever thread is free, so a
/// result must not depend on which thread did what. Stops early, between chunks, when `stop` returns true.
///
/// `body` and `stop` are called from several threads at once (`body` never twice at once with the same number). What
/// one of them throws, such as std::bad_alloc, ends the others' work and is thrown to the caller. When parallel_for
/// returns, all calls have ended and their writes are visible. It has no shared state: calls may be nested and made
/// from several threads.
void parallel_for(size_t count, size_t grain, int threads, const std::function<void(size_t, size_t, int)>& body,
                  const std::function<bool()>& stop = {});

}  // namespace lightwell
