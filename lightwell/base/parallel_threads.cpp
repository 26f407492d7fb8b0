// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "lightwell/base/parallel.h"

namespace lightwell {

int default_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void parallel_for(size_t count, size_t grain, int threads, const std::function<void(size_t, size_t, int)>& body,
                  const std::function<bool()>& stop) {
  grain = std::max<size_t>(grain, 1);
  const size_t chunks = count / grain + (count % grain != 0);
  if (threads <= 0) threads = default_threads();
  const int used = static_cast<int>(std::min<size_t>(chunks, static_cast<size_t>(threads)));
  std::atomic<size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&](int thread) {
    try {
      for (size_t chunk; (chunk = next++) < chunks;) {
        if (stop && stop()) return;
        body(chunk * grain, std::min(count, (chunk + 1) * grain), thread);
      }
    } catch (...) {
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
      next = chunks;
    }
  };
  std::vector<std::thread> others;
  try {
    for (int i = 1; i < used; i++) others.emplace_back(work, i);
  } catch (const std::exception&) {
    // The system has no more threads, or no memory for them: those that there are do the work.
  }
  work(0);
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lightwell
