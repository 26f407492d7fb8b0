// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>

#include "lightwell/server/connections.h"

namespace lightwell {

/// Holds each peer to a number of requests a second, of which it may save up those of one second (a token bucket). It
/// remembers who has asked within the last second, and nobody else.
class RequestRate {
 public:
  using Clock = std::chrono::steady_clock;

  /// 0 is any number.
  explicit RequestRate(double requests_per_second) : most_(requests_per_second) {}

  /// Whether a request of this peer is within its number.
  bool allows(const Peer& peer, Clock::time_point now);
  /// Forgets who has not asked for a second.
  void forget(Clock::time_point now);
  size_t remembered() const { return full_at_.size(); }

 private:
  double most_;
  std::map<Peer, Clock::time_point> full_at_;  ///< when a peer has saved up all that it may
};

}  // namespace lightwell
