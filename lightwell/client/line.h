// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lightwell/base/random.h"

namespace lightwell {

/// What is known of the line to the server: how fast it is, and whether it is worth trying now.
class Line {
 public:
  explicit Line(uint64_t seed) : random_(seed, 0) {}

  /// A request was sent; `alone` when no other was on its way.
  void sent(double now, bool alone);
  /// Bytes of bodies have arrived.
  void arrived(uint64_t bytes, double now);
  /// Something good came of a request: the line works.
  void succeeded() { failures_ = 0; }
  /// A request failed: pauses for a quarter of a second, doubled with every failure in a row up to 30 s, times a random
  /// number between one half and one.
  void failed(double now);

  /// Length of a request that takes about 100 ms at the measured rate, between 4 KB and 1 MB.
  uint64_t request_length() const;
  uint32_t failures() const { return failures_; }
  double retry_at() const { return retry_at_; }

 private:
  Random random_;
  double rate_ = 655360;  ///< bytes a second; at first such that a request of 64 KB takes 100 ms
  double measured_from_ = 0;
  uint64_t measured_bytes_ = 0;
  uint32_t failures_ = 0;
  double retry_at_ = 0;
};

}  // namespace lightwell
