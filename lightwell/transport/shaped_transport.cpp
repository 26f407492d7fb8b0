// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "lightwell/transport/transport.h"

namespace lightwell {
namespace {

constexpr size_t piece_bytes = 4096;

class ShapedTransport final : public Transport {
 public:
  ShapedTransport(std::unique_ptr<Transport> inner, const LineShape& shape) : inner_(std::move(inner)), shape_(shape) {}

  double now() override { return inner_->now(); }

  void ask(uint32_t request, uint64_t first, uint64_t last) override {
    answered_[request] = now() + shape_.latency;
    inner_->ask(request, first, last);
  }

  void cancel(uint32_t request) override {
    inner_->cancel(request);
    forget(request);
    std::erase_if(later_, [&](const Later& later) { return later.event.request == request; });
  }

  std::optional<TransportEvent> wait(double until) override {
    for (;;) {
      const double due = later_.empty() ? until : std::min(until, later_.front().time);
      if (std::optional<TransportEvent> event = inner_->wait(due)) {
        delay(std::move(*event));
        continue;
      }
      if (!later_.empty() && later_.front().time <= now()) {
        TransportEvent event = std::move(later_.front().event);
        later_.pop_front();
        if (event.kind == TransportEvent::Kind::end || event.kind == TransportEvent::Kind::failed)
          forget(event.request);
        return event;
      }
      if (now() >= until || later_.empty()) return std::nullopt;
    }
  }

 private:
  struct Later {
    double time = 0;
    TransportEvent event;
  };

  void forget(uint32_t request) { answered_.erase(request); }

  /// Queues an event, its bytes cut into pieces, behind all that the line carries before it.
  void delay(TransportEvent event) {
    const double earliest = std::max(now(), answered_[event.request]);
    if (event.kind != TransportEvent::Kind::bytes) return keep(earliest, std::move(event));
    for (size_t at = 0; at < event.bytes.size(); at += piece_bytes) {
      const size_t length = std::min(piece_bytes, event.bytes.size() - at);
      if (shape_.bits_per_second > 0)
        line_free_ = std::max(line_free_, earliest) + static_cast<double>(length) * 8 / shape_.bits_per_second;
      TransportEvent piece{TransportEvent::Kind::bytes, event.request, 0, {}, {}, {}};
      piece.bytes.assign(event.bytes.begin() + static_cast<std::ptrdiff_t>(at),
                         event.bytes.begin() + static_cast<std::ptrdiff_t>(at + length));
      keep(std::max(line_free_, earliest), std::move(piece));
    }
  }

  /// Keeps the events in the order of their times; those of one request keep their own order.
  void keep(double time, TransportEvent event) {
    for (const Later& later : later_)
      if (later.event.request == event.request) time = std::max(time, later.time);
    const auto behind = std::ranges::upper_bound(later_, time, {}, &Later::time);
    later_.insert(behind, {time, std::move(event)});
  }

  std::unique_ptr<Transport> inner_;
  LineShape shape_;
  double line_free_ = 0;                 ///< when the line has carried all bytes so far
  std::map<uint32_t, double> answered_;  ///< when the first sign of an answer may come
  std::deque<Later> later_;
};

}  // namespace

std::unique_ptr<Transport> shaped_transport(std::unique_ptr<Transport> inner, const LineShape& shape) {
  return std::make_unique<ShapedTransport>(std::move(inner), shape);
}

}  // namespace lightwell
