// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lightwell/base/random.h"

namespace lightwell {

/// Estimates the connection to the server: its throughput, which determines the length of requests, and when to try
/// again after failures.
class LineEstimate {
 public:
  explicit LineEstimate(uint64_t seed) : random_(seed, 0) {}

  /// A request was sent; `alone` when no other is in flight, in which case the throughput is measured from now on.
  void sent(double now, bool alone);
  /// Bytes of bodies have arrived.
  void arrived(uint64_t bytes, double now);
  /// A request delivered valid bytes: the connection works.
  void succeeded() { failures_ = 0; }
  /// A request failed. Pauses for a quarter of a second, doubled with every consecutive failure up to 30 s, times a
  /// random factor between 0.5 and 1, and halves the throughput.
  void failed(double now);

  /// The length, in bytes, of a request that takes about 100 ms at the measured rate, between 4 KB and 1 MB.
  uint64_t request_length() const;
  /// Consecutive failures.
  uint32_t failures() const { return failures_; }
  /// The time before which no request should be sent.
  double retry_at() const { return retry_at_; }

 private:
  Random random_;
  double throughput_ = 655360;  ///< bytes per second; initially 64 KB take 100 ms
  double measured_from_ = 0;
  uint64_t measured_bytes_ = 0;
  uint32_t failures_ = 0;
  double retry_at_ = 0;
};

}  // namespace lightwell
