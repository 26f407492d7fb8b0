// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/requests.h"

#include <algorithm>
#include <limits>

namespace lightwell {
namespace {

constexpr size_t most_in_flight = 4;
constexpr double patience_seconds = 20;         // with a silent server
constexpr uint64_t longest_backlog = 8u << 20;  // bytes of blocks waiting to be decoded
constexpr double never = std::numeric_limits<double>::infinity();

/// Answers in a row that are of no use before something else is tried.
constexpr uint32_t most_useless = 3;

FailureUpdate wrong_length(uint64_t found, uint64_t stated) {
  return {FailureUpdate::Reason::unreadable, ErrorKind::bad_input,
          "the file has " + std::to_string(found) + " bytes, but should have " + std::to_string(stated)};
}

bool worth_another_try(int status) { return status == 408 || status == 425 || status == 429 || status >= 500; }

}  // namespace

std::optional<Action> Requests::next(std::span<const float> weights, double now) {
  looked_ = now;
  if (!stopped_) drop_silent(now);
  if (!cancels_.empty()) {
    const uint32_t id = cancels_.back();
    cancels_.pop_back();
    return Action{Action::Kind::cancel, id};
  }
  if (stopped_ || whole_file_request_ || now < line_.retry_at()) return std::nullopt;
  if (whole_file_only_) return open_.empty() ? std::optional(ask_for_all(now)) : std::nullopt;
  if (!rests_.empty()) return ask_for_rest(now);
  if (!download_.opened()) {
    if (!open_.empty()) return std::nullopt;
    return ask(download_.wanted_head(), std::nullopt, now);
  }
  return ask_for_extents(weights, now);
}

std::optional<Action> Requests::ask_for_extents(std::span<const float> weights, double now) {
  // While the connection is in doubt, one request is enough to test it.
  if (open_.size() >= (line_.failures() > 0 ? 1 : most_in_flight)) return std::nullopt;
  // The request for the opening is still delivering blocks; that for the witness decides whether to go on.
  if (std::ranges::any_of(open_, [](const auto& open) { return !open.second.run; })) return std::nullopt;
  if (download_.suspicious()) return ask(download_.wanted_witness(), std::nullopt, now);
  if (download_.backlog() > longest_backlog) return std::nullopt;
  const std::optional<Run> run = choose(order_, strategy_, weights, line_.request_length(), most_in_flight);
  if (!run) return std::nullopt;
  order_.asked(*run);
  return ask({run->begin, run->end}, run, now);
}

Action Requests::ask(std::pair<uint64_t, uint64_t> bytes, std::optional<Run> run, double now) {
  line_.sent(now, open_.empty());
  const uint32_t id = next_id_++;
  Request& request = open_[id];
  request.cursor.position = bytes.first;
  request.end = bytes.second;
  request.run = run;
  request.heard = now;
  return {Action::Kind::ask, id, bytes.first, bytes.second - 1};
}

Action Requests::ask_for_rest(double now) {
  Rest rest = std::move(rests_.back());
  rests_.pop_back();
  const Action action = ask({rest.cursor.position, rest.end}, rest.run, now);
  open_[action.id].cursor = std::move(rest.cursor);
  return action;
}

Action Requests::ask_for_all(double now) {
  Action action = ask({0, std::numeric_limits<uint64_t>::max()}, std::nullopt, now);
  action.last = Action::to_the_end;
  return action;
}

void Requests::respond(uint32_t id, const ResponseHead& head, double now) {
  const auto request = open_.find(id);
  if (request == open_.end()) return;
  request->second.heard = now;
  if (head.status != 200 && head.status != 206) return respond_refused(request, head, now);
  request->second.answered = true;
  note_etag(head.etag);
  if (head.status == 206) return respond_partial(request, head.content_range, now);
  respond_whole(request);
}

void Requests::respond_partial(Open::iterator request, std::string_view content_range, double now) {
  if (content_range.empty()) return;  // hidden by CORS: assume the requested range
  const std::optional<ContentRange> range = ContentRange::parse(content_range);
  if (!range || range->first != request->second.cursor.position) {
    const uint32_t id = request->first;
    distrust();
    if (const auto left = open_.find(id); left != open_.end()) abandon(left, now);
    return;
  }
  ranges_shown_ = true;
  if (range->total) check_length(*range->total);
}

/// Handles a server that ignores ranges: its one response delivers the whole file, as would those to all other
/// requests, which are therefore dropped.
void Requests::respond_whole(Open::iterator request) {
  whole_file_request_ = request->first;
  request->second.cursor.position = 0;
  request->second.end = std::numeric_limits<uint64_t>::max();
  for (auto other = open_.begin(); other != open_.end();) {
    const auto current = other++;
    if (current == request) continue;
    cancels_.push_back(current->first);
    if (current->second.run) order_.unasked(*current->second.run);
    open_.erase(current);
  }
  drop_rests();
}

void Requests::respond_refused(Open::iterator request, const ResponseHead& head, double now) {
  using Reason = FailureUpdate::Reason;
  const int status = head.status;
  if (status == 416 && download_.opened())
    return give_up(Reason::replaced, "the file has become shorter: it was replaced or cut");
  if (status == 416) return give_up(Reason::unreadable, "the file is empty or cut short");
  if (!worth_another_try(status)) return give_up(Reason::refused, "the server answers " + std::to_string(status));
  abandon(request, now);
}

void Requests::receive(uint32_t id, Bytes bytes, double now) {
  const auto found = open_.find(id);
  if (found == open_.end()) return;
  Request& request = found->second;
  request.heard = now;
  request.arriving = request.arriving || !bytes.empty();
  line_.arrived(bytes.size(), now);
  const uint64_t wanted = request.end - std::min(request.end, request.cursor.position);
  const Bytes used = bytes.first(static_cast<size_t>(std::min<uint64_t>(bytes.size(), wanted)));
  const Result<uint64_t> gained = download_.receive(request.cursor, used);
  if (!gained && is_fault_of_ranges()) return;
  if (!gained) return give_up(FailureUpdate::unreadable(gained.error()));
  if (download_.replaced() && is_fault_of_ranges()) return;
  if (download_.replaced()) return give_up(FailureUpdate::Reason::replaced, "the file was replaced while it was read");
  request.gained += *gained;
  if (*gained > 0) {
    line_.succeeded();
    ever_gained_ = true;
    useless_ = 0;
  }
  if (!download_.opened() && request.cursor.position > download_.wanted_head().first) return abandon(found, now);
  if (length_ != 0) check_length(length_);
}

void Requests::finish(uint32_t id, double now) {
  const auto request = open_.find(id);
  if (request == open_.end()) return;
  Request& ended = request->second;
  if (leaves_rest(ended)) {
    rests_.push_back({std::move(ended.cursor), ended.end, *ended.run});
    open_.erase(request);
    return;
  }
  const bool failed = ended.gained == 0;
  const bool whole = whole_file_request_ == id;
  if (whole) {
    const uint64_t length = ended.cursor.position, stated = download_.opened() ? download_.file_length() : 0;
    if (whole_file_only_ && length < stated && length == whole_length_) return give_up(wrong_length(length, stated));
    whole_length_ = length;
  }
  if (failed && (whole || (ended.answered && !ended.arriving))) distrust();
  if (const auto left = open_.find(id); left != open_.end()) end(left, failed, now);
}

bool Requests::leaves_rest(const Request& request) const {
  const uint64_t length = download_.file_length();
  return request.answered && request.arriving && request.run && request.cursor.position < request.end &&
         request.cursor.position < length && whole_file_request_ == std::nullopt;
}

void Requests::distrust() {
  if (++useless_ < most_useless) return;
  if (!whole_file_only_) return ask_for_nothing_but_all();
  give_up(FailureUpdate::Reason::refused,
          "the server's answers to requests for parts of the file (Range) are of no use, nor is its whole answer");
}

/// A server whose answers to ranges are of no use gets a plain request, which works everywhere.
void Requests::ask_for_nothing_but_all() {
  whole_file_only_ = true;
  useless_ = 0;
  length_ = 0;
  for (const auto& [id, request] : open_) {
    cancels_.push_back(id);
    if (request.run) order_.unasked(*request.run);
  }
  open_.clear();
  drop_rests();
  whole_file_request_.reset();
}

void Requests::drop_rests() {
  for (const Rest& rest : rests_) order_.unasked(rest.run);
  rests_.clear();
}

bool Requests::is_fault_of_ranges() {
  if (whole_file_only_ || whole_file_request_ || ranges_shown_) return false;
  download_.forget_damage();
  ask_for_nothing_but_all();
  return true;
}

void Requests::fail(uint32_t id, double now) {
  const auto request = open_.find(id);
  if (request == open_.end()) return;
  // Content that a browser cannot decode fails as a broken connection does: at once, or before there is anything.
  const Request& failed = request->second;
  if (failed.answered && failed.gained == 0 && (!failed.arriving || !ever_gained_)) distrust();
  if (const auto left = open_.find(id); left != open_.end()) end(left, true, now);
}

void Requests::end(Open::iterator request, bool failed, double now) {
  if (request->second.run) order_.unasked(*request->second.run);
  if (failed) line_.failed(now);
  if (whole_file_request_ == request->first) whole_file_request_.reset();
  open_.erase(request);
}

void Requests::abandon(Open::iterator request, double now) {
  cancels_.push_back(request->first);
  end(request, true, now);
}

void Requests::drop_silent(double now) {
  for (auto request = open_.begin(); request != open_.end();) {
    const auto current = request++;
    if (now >= current->second.heard + patience_seconds) abandon(current, now);
  }
}

void Requests::check_length(uint64_t length) {
  const uint64_t before = length_ != 0 ? length_ : length;
  length_ = length;
  const uint64_t stated = download_.file_length();
  if (before != length)
    give_up(FailureUpdate::Reason::replaced, "the file was replaced while it was read: its length has changed");
  else if (stated != 0 && stated != length && download_.opened()) {
    // It may be the length of what a server makes of the file on the way, such as gzip.
    if (whole_file_only_ || whole_file_request_) return give_up(wrong_length(length, stated));
    whole_length_ = length;  // or that of a file that has been cut
    ask_for_nothing_but_all();
  }
}

/// Notes a response's ETag. Replicated servers may give equal files different ETags, so the first difference only
/// causes one check whether the file is still the same. Later ETags are ignored, and the checks of the blocks decide.
void Requests::note_etag(std::string_view etag) {
  if (etag.empty() || etags_differ_) return;
  if (etag_.empty()) etag_ = etag;
  etags_differ_ = etag_ != etag;
  if (etags_differ_) download_.suspect();
}

void Requests::give_up(FailureUpdate failure) {
  if (!failure_) failure_ = std::move(failure);
  stop();
}

void Requests::give_up(FailureUpdate::Reason reason, std::string message) {
  const bool file = reason == FailureUpdate::Reason::unreadable;
  give_up({reason, file ? ErrorKind::bad_input : ErrorKind::io, std::move(message)});
}

void Requests::stop() {
  stopped_ = true;
  for (const auto& [id, request] : open_) cancels_.push_back(id);
  open_.clear();
  whole_file_request_.reset();
}

bool Requests::opening_brings(uint64_t position) const {
  return std::ranges::any_of(open_, [&](const auto& open) {
    const Request& request = open.second;
    return !request.run && request.cursor.position < position && position <= request.end;
  });
}

/// The earliest end of a pause or of the patience with a request. A pause that has ended since the last next() counts,
/// since nothing has been requested since then.
double Requests::wake() const {
  if (stopped_) return never;
  double when = line_.retry_at() > looked_ ? line_.retry_at() : never;
  for (const auto& [id, request] : open_) when = std::min(when, request.heard + patience_seconds);
  return when;
}

}  // namespace lightwell
