// SPDX-License-Identifier: Apache-2.0
#include "lightwell/transport/fetch.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace lightwell {
namespace {

constexpr size_t unlimited = std::numeric_limits<size_t>::max();
constexpr double timeline_seconds = 0.01;
constexpr double longest_wait = 0.5;  // so that cancelling does not wait for a silent line

void perform(Client& client, Transport& transport) {
  while (const std::optional<Action> action = client.next(transport.now())) {
    if (action->kind == Action::Kind::ask)
      transport.ask(action->id, action->first, action->last);
    else
      transport.cancel(action->id);
  }
}

void report(Client& client, const TransportEvent& event, double now) {
  switch (event.kind) {
    case TransportEvent::Kind::head:
      return client.respond(event.request, {event.status, event.content_range, event.etag}, now);
    case TransportEvent::Kind::bytes: return client.receive(event.request, event.bytes, now);
    case TransportEvent::Kind::end: return client.finish(event.request, now);
    case TransportEvent::Kind::failed: return client.fail(event.request, now);
  }
}

/// Follows the updates of a run and remembers when there was what.
class Watcher {
 public:
  explicit Watcher(const std::function<void(const Update&)>& apply) : apply_(apply) {}

  /// Decodes and hands over all that is there.
  void drain(Client& client) {
    bool more = true;
    while (more) {
      more = client.work();
      while (const std::optional<Update> update = client.take(unlimited)) {
        more = true;
        changed_ = true;
        if (std::holds_alternative<OpeningUpdate>(*update)) opened_ = true;
        if (const auto* failed = std::get_if<FailureUpdate>(&*update)) failure_ = failed->message;
        apply_(*update);
      }
    }
  }

  void remember(const Client& client, double now, FetchOutcome& outcome) {
    if (!changed_) return;
    const ClientProgress progress = client.progress();
    const FetchOutcome::Moment moment{now, progress.bytes, progress.faces, progress.nodes};
    if (opened_ && outcome.first_picture.bytes == 0) outcome.first_picture = moment;
    const bool due = outcome.timeline.empty() || now >= outcome.timeline.back().seconds + timeline_seconds;
    if (!due && !client.ended()) return;
    outcome.timeline.push_back(moment);
    changed_ = false;
  }

  const std::optional<std::string>& failure() const { return failure_; }

 private:
  const std::function<void(const Update&)>& apply_;
  std::optional<std::string> failure_;
  bool opened_ = false;
  bool changed_ = false;
};

}  // namespace

Result<FetchOutcome> fetch(Client& client, Transport& transport, const std::function<void(const Update&)>& apply,
                           const std::function<bool()>& cancelled) {
  FetchOutcome outcome;
  Watcher watcher(apply);
  while (!client.ended()) {
    if (cancelled && cancelled()) return fail("fetch", "was cancelled");
    perform(client, transport);
    const double now = transport.now();
    const double until = std::min(client.wake(), now + longest_wait);
    if (const std::optional<TransportEvent> event = transport.wait(until)) report(client, *event, transport.now());
    watcher.drain(client);
    watcher.remember(client, transport.now(), outcome);
  }
  if (watcher.failure()) return fail("", *watcher.failure());
  perform(client, transport);
  outcome.bytes = client.progress().bytes;
  outcome.requests = client.progress().requests;
  outcome.seconds = transport.now();
  return outcome;
}

}  // namespace lightwell
