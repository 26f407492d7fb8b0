// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace lightwell {

/// The order in which each pass visits the points present: every point is followed by the children that it got in the
/// pass before, so that neighbours in the sweep stay neighbours on the surface.
class Sweep {
 public:
  explicit Sweep(uint32_t base_points) : next_(base_points) { std::iota(next_.begin(), next_.end(), 0u); }

  /// Starts the next pass. There must be a point.
  void begin_pass() {
    if (!order_.empty()) next_.insert(next_.end(), order_.begin() + static_cast<ptrdiff_t>(at_) + 1, order_.end());
    order_.swap(next_);
    next_.clear();
    at_ = 0;
    work_ += order_.size();
    next_.push_back(order_[0]);
  }
  /// The current point.
  uint32_t point() const { return order_[at_]; }
  /// Goes on to the next point; false when there is none.
  bool advance() {
    if (at_ + 1 == order_.size()) return false;
    next_.push_back(order_[++at_]);
    return true;
  }
  /// Adds a child of the current point.
  void add(uint32_t child) { next_.push_back(child); }
  /// The number of visits in all passes so far.
  uint64_t work() const { return work_; }

 private:
  std::vector<uint32_t> order_, next_;
  size_t at_ = 0;
  uint64_t work_ = 0;
};

}  // namespace lightwell
