// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <deque>

#include "lightwell/transport/transport.h"

namespace lightwell {
namespace {

class MemoryTransport final : public Transport {
 public:
  explicit MemoryTransport(std::vector<uint8_t> file) : file_(std::move(file)) {}

  double now() override { return now_; }

  void ask(uint32_t request, uint64_t first, uint64_t last) override {
    using Kind = TransportEvent::Kind;
    const std::string total = std::to_string(file_.size());
    if (first >= file_.size()) {
      events_.push_back({Kind::head, request, 416, "bytes */" + total, {}, {}});
    } else {
      last = std::min<uint64_t>(last, file_.size() - 1);
      const std::string range = "bytes " + std::to_string(first) + "-" + std::to_string(last) + "/" + total;
      const auto begin = file_.begin() + static_cast<std::ptrdiff_t>(first);
      events_.push_back({Kind::head, request, 206, range, {}, {}});
      events_.push_back(
          {Kind::bytes, request, 0, {}, {}, {begin, file_.begin() + static_cast<std::ptrdiff_t>(last + 1)}});
    }
    events_.push_back({Kind::end, request, 0, {}, {}, {}});
  }

  void cancel(uint32_t request) override {
    std::erase_if(events_, [&](const TransportEvent& event) { return event.request == request; });
  }

  std::optional<TransportEvent> wait(double until) override {
    if (events_.empty()) {
      if (std::isfinite(until)) now_ = std::max(now_, until);
      return std::nullopt;
    }
    TransportEvent event = std::move(events_.front());
    events_.pop_front();
    return event;
  }

 private:
  std::vector<uint8_t> file_;
  std::deque<TransportEvent> events_;
  double now_ = 0;
};

}  // namespace

std::unique_ptr<Transport> memory_transport(std::vector<uint8_t> file) {
  return std::make_unique<MemoryTransport>(std::move(file));
}

}  // namespace lightwell
