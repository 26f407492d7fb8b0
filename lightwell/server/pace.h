// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace lightwell {

/// How long a client may go on taking an answer: every 16 KB that it has taken buy it the same time once more. It may
/// take them in whatever portions its system does, which are a megabyte where buffers are large, so time can be bought
/// in advance, as much as 512 KB do.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr uint64_t portion = 16384;  ///< bytes that buy time
  static constexpr int most_portions = 32;    ///< in advance

  /// `time` is what a portion buys, and what there is at the beginning.
  Pace(Clock::time_point begin, Clock::duration time) : begin_(begin), time_(time), end_(begin + time) {}

  /// Says how many bytes have been taken from the beginning until `now`.
  void taken(uint64_t bytes, Clock::time_point now);
  /// When the time is up.
  Clock::time_point end() const { return end_; }
  /// Bytes a second from the beginning until `now`.
  double rate(Clock::time_point now) const;

 private:
  Clock::time_point begin_;
  Clock::duration time_;
  Clock::time_point end_;
  uint64_t taken_ = 0;
};

}  // namespace lightwell
