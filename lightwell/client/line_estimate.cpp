// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/line_estimate.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

constexpr double request_seconds = 0.1;
constexpr double shortest_request = 4096;
constexpr double longest_request = 1 << 20;
constexpr double measure_seconds = 0.1;
constexpr double first_pause = 0.25;
constexpr double longest_pause = 30;

}  // namespace

void LineEstimate::sent(double now, bool alone) {
  if (!alone) return;
  measured_from_ = now;
  measured_bytes_ = 0;
}

void LineEstimate::arrived(uint64_t bytes, double now) {
  measured_bytes_ += bytes;
  const double seconds = now - measured_from_;
  if (seconds < measure_seconds && static_cast<double>(measured_bytes_) < longest_request) return;
  throughput_ = (throughput_ + static_cast<double>(measured_bytes_) / std::max(seconds, 1e-3)) / 2;
  measured_from_ = now;
  measured_bytes_ = 0;
}

void LineEstimate::failed(double now) {
  const double pause = std::min(longest_pause, std::ldexp(first_pause, static_cast<int>(std::min(failures_, 16u))));
  retry_at_ = std::max(retry_at_, now + pause * (0.5 + 0.5 * static_cast<double>(random_.uniform())));
  failures_++;
  throughput_ /= 2;
}

uint64_t LineEstimate::request_length() const {
  return static_cast<uint64_t>(std::clamp(throughput_ * request_seconds, shortest_request, longest_request));
}

}  // namespace lightwell
