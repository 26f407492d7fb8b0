// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lightwell/base/random.h"

namespace lightwell {

/// An estimate of the line to the server, from what its requests bring: its throughput in bytes a second, which decides
/// how much a request asks for, and when it is worth trying again after failures.
class LineEstimate {
 public:
  explicit LineEstimate(uint64_t seed) : random_(seed, 0) {}

  /// A request was sent; `alone` when no other was on its way: then the throughput is measured from now on.
  void sent(double now, bool alone);
  /// Bytes of bodies have arrived.
  void arrived(uint64_t bytes, double now);
  /// Something good came of a request: the line works.
  void succeeded() { failures_ = 0; }
  /// A request failed: pauses for a quarter of a second, doubled with every failure in a row up to 30 s, times a random
  /// number between one half and one.
  void failed(double now);

  /// The length, in bytes, of a request that takes about 100 ms at the measured rate, between 4 KB and 1 MB.
  uint64_t request_length() const;
  /// Failures since something good came.
  uint32_t failures() const { return failures_; }
  /// The time before which no request should be sent.
  double retry_at() const { return retry_at_; }

 private:
  Random random_;
  double throughput_ = 655360;  ///< bytes a second; at first such that a request of 64 KB takes 100 ms
  double measured_from_ = 0;
  uint64_t measured_bytes_ = 0;
  uint32_t failures_ = 0;
  double retry_at_ = 0;
};

}  // namespace lightwell
