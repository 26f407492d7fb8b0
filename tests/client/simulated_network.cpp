// SPDX-License-Identifier: Apache-2.0
#include "tests/client/simulated_network.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

constexpr size_t piece_bytes = 3000;
constexpr size_t budget = 65536;

ReceivedScene SimulatedNetwork::run(const ClientOptions& options, double patience) {
  Client client(options);
  ReceivedScene scene;
  while (!client.ended() && now_ < patience && complaint_.empty()) {
    perform(client);
    drain(client, scene);
    perform(client);
    now_ += weather_.busy;
    const double wake = client.wake();
    if (!events_.empty() && events_.begin()->first <= wake) {
      const auto next = events_.begin();
      now_ = std::max(now_, next->first);
      const Event event = std::move(next->second);
      events_.erase(next);
      deliver(client, event);
    } else if (std::isfinite(wake)) {
      now_ = std::max(now_, wake);
    } else if (!client.ended()) {
      complaint_ = "the client waits for nothing";
    }
  }
  drain(client, scene);
  perform(client);
  if (complaint_.empty() && client.ended() && !in_flight_.empty()) complaint_ = "a request was left open";
  return scene;
}

void SimulatedNetwork::perform(Client& client) {
  while (const std::optional<Action> action = client.next(now_)) {
    if (action->kind == Action::Kind::ask) {
      ask(*action);
      continue;
    }
    in_flight_.erase(action->id);
    std::erase_if(events_, [&](const auto& event) { return event.second.request == action->id; });
  }
}

void SimulatedNetwork::ask(const Action& action) {
  using Kind = Event::Kind;
  in_flight_.insert(action.id);
  most_in_flight_ = std::max(most_in_flight_, in_flight_.size());
  const double time = now_ + weather_.latency + weather_.jitter * random_.uniform();
  if (chance(weather_.silent)) return;
  if (chance(weather_.lost) || (now_ >= weather_.gone_from && now_ < weather_.gone_until)) {
    events_.emplace(time, Event{Kind::failed, action.id, 0, {}, {}, false});
    return;
  }
  const bool replaced = now_ >= weather_.replaced_at;
  const Bytes file = (replaced ? replacement_ : file_)
                         .first(std::min(weather_.serves_bytes, (replaced ? replacement_ : file_).size()));
  const std::string total = std::to_string(file.size());
  Event head{Kind::head, action.id, 206, {}, {}, replaced};
  uint64_t first = action.first, last = std::min<uint64_t>(action.last, file.size() - 1);
  if (chance(weather_.overloaded)) {
    head.status = 503;
    last = first;
  } else if (!weather_.ranges || action.last == Action::to_the_end) {
    head.status = 200;
    first = 0;
    last = std::min<uint64_t>(file.size(), weather_.whole_bytes) - 1;
  } else if (first >= file.size()) {
    head.status = 416;
    head.content_range = "bytes */" + total;
  } else {
    last = first + std::min(last - first, weather_.longest_range - 1);
    head.content_range = "bytes " + std::to_string(first) + "-" + std::to_string(last) + "/" + total;
  }
  const bool partial = head.status == 206;
  if (partial && weather_.wrong_ranges) head.content_range = "bytes 7-8/" + total;
  if (partial && weather_.nonsense) head.content_range.clear();
  events_.emplace(time, head);
  if (partial && weather_.undecodable) {
    events_.emplace(time, Event{Kind::failed, action.id, 0, {}, {}, false});
    return;
  }
  if (head.status == 416) {
    events_.emplace(time, Event{Kind::end, action.id, 0, {}, {}, false});
    return;
  }
  if (partial && weather_.nonsense && first > 0) first = 0, last = std::min<uint64_t>(last, file.size() - 1);
  const Bytes body = file.subspan(first, last + 1 - first);
  send_body(action.id, {body.begin(), body.end()}, time);
  if (chance(weather_.repeated)) {
    events_.emplace(time + 1, head);
    send_body(action.id, {body.begin(), body.end()}, time + 1);
  }
}

/// The body's pieces at the line's rate, with whatever happens to them.
void SimulatedNetwork::send_body(uint32_t request, std::vector<uint8_t> body, double time) {
  using Kind = Event::Kind;
  if (chance(weather_.corrupted))
    body[random_.below(static_cast<uint32_t>(body.size()))] ^= static_cast<uint8_t>(1u << random_.below(8));
  bool broken = chance(weather_.broken);
  if (broken || chance(weather_.truncated)) body.resize(random_.below(static_cast<uint32_t>(body.size())));
  if (request == 1 && body.size() > weather_.first_body_bytes) {
    broken = true;
    body.resize(weather_.first_body_bytes);
  }
  for (size_t at = 0; at < body.size(); at += piece_bytes) {
    const size_t end = std::min(body.size(), at + piece_bytes);
    line_free_ = std::max(line_free_, time) + static_cast<double>(end - at) / weather_.rate;
    time = line_free_;
    const auto begin = body.begin();
    events_.emplace(time, Event{Kind::bytes,
                                request,
                                0,
                                {},
                                {begin + static_cast<std::ptrdiff_t>(at), begin + static_cast<std::ptrdiff_t>(end)},
                                false});
  }
  events_.emplace(time, Event{broken ? Kind::failed : Kind::end, request, 0, {}, {}, false});
}

void SimulatedNetwork::deliver(Client& client, const Event& event) {
  switch (event.kind) {
    case Event::Kind::head: {
      const bool readable = weather_.readable_headers;
      const std::string etag =
          (event.replaced ? "\"b" : "\"a") + std::to_string(event.request % weather_.servers) + "\"";
      client.respond(event.request, {event.status, readable ? event.content_range : "", readable ? etag : ""}, now_);
      return;
    }
    case Event::Kind::bytes: return client.receive(event.request, event.bytes, now_);
    case Event::Kind::end: client.finish(event.request, now_); break;
    case Event::Kind::failed: client.fail(event.request, now_); break;
  }
  in_flight_.erase(event.request);
}

void SimulatedNetwork::drain(Client& client, ReceivedScene& scene) {
  for (bool more = true; more;) {
    more = client.work();
    const std::optional<Update> update = client.take(budget);
    if (!update) continue;
    more = true;
    if (complaint_.empty()) complaint_ = scene.apply(*update);
  }
}

}  // namespace lightwell
