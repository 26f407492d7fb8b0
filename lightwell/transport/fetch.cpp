// SPDX-License-Identifier: Apache-2.0
#include "lightwell/transport/fetch.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <optional>

namespace lightwell {
namespace {

constexpr size_t unlimited = std::numeric_limits<size_t>::max();
constexpr double timeline_seconds = 0.01;
constexpr double longest_wait = 0.5;  // so that cancelling does not wait for a silent line
constexpr int first_refusal = 400;    // the least HTTP status that is none of success

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

/// Hands the updates of a client on and keeps the time of each advance.
class Watcher {
 public:
  explicit Watcher(const std::function<void(const Update&)>& apply) : apply_(apply) {}

  /// Decodes and hands on all that is there.
  void drain(Client& client) {
    bool more = true;
    while (more) {
      more = client.work();
      while (const std::optional<Update> update = client.take(unlimited)) {
        more = true;
        changed_ = true;
        if (std::holds_alternative<OpeningUpdate>(*update)) opened_ = true;
        if (const auto* failed = std::get_if<FailureUpdate>(&*update)) failure_ = *failed;
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

  const std::optional<FailureUpdate>& failure() const { return failure_; }

 private:
  const std::function<void(const Update&)>& apply_;
  std::optional<FailureUpdate> failure_;
  bool opened_ = false;
  bool changed_ = false;
};

constexpr const char* silence = "the server does not answer";

/// The reason of an event that makes a client try again; empty when the server is not to blame.
std::string reason_of(const TransportEvent& event) {
  if (event.kind == TransportEvent::Kind::failed) return event.reason;
  if (event.kind == TransportEvent::Kind::head && event.status >= first_refusal)
    return "the server answers " + std::to_string(event.status);
  return {};
}

/// A witness of when the server goes silent and when it is back.
class Listener {
 public:
  Listener(const FetchGuard& guard, double now) : guard_(guard), heard_(now) {}

  void hear(const TransportEvent& event, double now) {
    if (event.kind == TransportEvent::Kind::bytes) heard_ = now;
  }

  /// Tells of an outage, for the given reason, when the client has failed since the last look.
  void look(const Client& client, const std::string& reason) {
    const uint32_t failures = client.progress().failures;
    if (failures > failures_ && !reason.empty()) {
      if (outage_.empty() && guard_.outage) guard_.outage(reason);
      outage_ = reason;
    }
    if (failures == 0) outage_.clear();
    failures_ = failures;
  }

  /// The time at which patience ends.
  double end() const { return heard_ + guard_.patience; }
  std::string last_words() const {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%g", guard_.patience);
    return (outage_.empty() ? silence : outage_) + "; gave up after " + seconds + " s";
  }

 private:
  const FetchGuard& guard_;
  double heard_;  ///< when the last bytes came
  uint32_t failures_ = 0;
  std::string outage_;  ///< the latest reason while it lasts
};

}  // namespace

Result<FetchOutcome> fetch(Client& client, Transport& transport, const std::function<void(const Update&)>& apply,
                           const FetchGuard& guard) {
  FetchOutcome outcome;
  Watcher watcher(apply);
  Listener listener(guard, transport.now());
  while (!client.ended()) {
    if (guard.cancelled && guard.cancelled()) return fail(ErrorKind::cancelled, "fetch", "was cancelled");
    perform(client, transport);
    listener.look(client, silence);
    const double now = transport.now();
    const double until = std::min({client.wake(), now + longest_wait, listener.end()});
    const std::optional<TransportEvent> event = transport.wait(until);
    // What waits is heard first: the process may have slept.
    if (!event && transport.now() >= listener.end()) return fail(ErrorKind::io, "", listener.last_words());
    if (event) {
      listener.hear(*event, transport.now());
      report(client, *event, transport.now());
      listener.look(client, reason_of(*event));
    }
    watcher.drain(client);
    watcher.remember(client, transport.now(), outcome);
  }
  if (watcher.failure()) return fail(watcher.failure()->kind, "", watcher.failure()->message);
  perform(client, transport);
  outcome.bytes = client.progress().bytes;
  outcome.requests = client.progress().requests;
  outcome.seconds = transport.now();
  return outcome;
}

}  // namespace lightwell
