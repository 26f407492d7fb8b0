// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/request_rate.h"

#include <algorithm>

namespace lightwell {

bool RequestRate::allows(const Peer& peer, Clock::time_point now) {
  if (most_ == 0) return true;
  constexpr std::chrono::seconds saved(1);
  const auto price = std::chrono::duration_cast<Clock::duration>(saved / most_);
  Clock::time_point& full_at = full_at_.try_emplace(peer, now).first->second;
  const Clock::time_point then = std::max(full_at, now) + price;
  if (then > now + std::max<Clock::duration>(saved, price)) return false;
  full_at = then;
  return true;
}

void RequestRate::forget(Clock::time_point now) {
  std::erase_if(full_at_, [&](const auto& peer) { return peer.second <= now; });
}

}  // namespace lightwell
