// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/pace.h"

#include <algorithm>

namespace lightwell {

void Pace::taken(uint64_t bytes, Clock::time_point now) {
  if (bytes <= taken_) return;
  const double portions = static_cast<double>(bytes - taken_) / static_cast<double>(portion);
  const double bought = std::min(portions, static_cast<double>(most_portions));
  taken_ = bytes;
  end_ = std::min(end_ + std::chrono::duration_cast<Clock::duration>(time_ * bought), now + time_ * most_portions);
}

double Pace::rate(Clock::time_point now) const {
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  return static_cast<double>(taken_) / std::max(seconds, 1e-3);
}

}  // namespace lightwell
