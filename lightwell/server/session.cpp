// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/session.h"

#include <linux/sockios.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/sendfile.h>

#include <algorithm>

#include "lightwell/server/http_date.h"

namespace lightwell {
namespace {

constexpr size_t longest_header = 8192;
constexpr size_t longest_turn = 1u << 18;  // bytes sent for one connection before the others have their turn
constexpr int most_unsent = 1 << 17;       // bytes that the system keeps ready for a connection, beside those under way
constexpr std::chrono::seconds lingering(2);     // for a client that reads the last answer of a connection
constexpr std::chrono::seconds judged_after(1);  // an exchange over a line of any length has brought something

/// A request names its host once; of HTTP/1.0 it need not (RFC 9112, 3.2).
bool names_one_host(const http::request<http::empty_body>& request) {
  const size_t hosts = request.count(http::field::host);
  return hosts == 1 || (hosts == 0 && request.version() < 11);
}

RequestHead head_of(const http::request<http::empty_body>& request) {
  const auto field = [&](http::field name) { return std::string(request[name].data(), request[name].size()); };
  return {.method = std::string(request.method_string()),
          .target = std::string(request.target()),
          .range = field(http::field::range),
          .if_range = field(http::field::if_range),
          .if_match = field(http::field::if_match),
          .if_none_match = field(http::field::if_none_match),
          .accept_encoding = field(http::field::accept_encoding)};
}

std::string head_text(const Answer& answer, bool keep_alive) {
  const http::status status = http::int_to_status(static_cast<unsigned>(answer.status));
  std::string text = "HTTP/1.1 " + std::to_string(answer.status) + " " + std::string(http::obsolete_reason(status)) +
                     "\r\nServer: lightwell\r\nDate: " + http_date(std::time(nullptr)) + "\r\n";
  for (const auto& [name, value] : answer.fields) text.append(name).append(": ").append(value).append("\r\n");
  if (answer.status != 204 && answer.status != 304)
    text.append("Content-Length: ").append(std::to_string(answer.length)).append("\r\n");
  return text.append(keep_alive ? "\r\n" : "Connection: close\r\n\r\n");
}

}  // namespace

Session::Session(tcp::socket socket, const Peer& peer, Shared& shared)
    : Connection(peer), shared_(shared), socket_(std::move(socket)), buffer_(longest_header) {
  shared_.connections.enter(*this);
}

Session::~Session() {
  shared_.connections.leave(*this);
  shared_.left();
}

void Session::start() {
  error_code ignored;
  socket_.set_option(tcp::no_delay(true), ignored);
  ::setsockopt(socket_.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &most_unsent, sizeof most_unsent);
  socket_.native_non_blocking(true, ignored);
  idle_end_ = Clock::now() + shared_.options.idle;
  await_request();
}

Connection::Clock::time_point Session::deadline(Clock::time_point now) {
  if (!pace_) return idle_end_;
  int waiting = 0;  // bytes that the system holds until the client takes them
  if (::ioctl(socket_.native_handle(), SIOCOUTQ, &waiting) == 0)
    pace_->taken(sent_ - std::min(sent_, static_cast<uint64_t>(waiting)), now);
  return pace_->end();
}

std::optional<double> Session::rate(Clock::time_point now) const {
  if (now < began_ + judged_after) return std::nullopt;
  return pace_ ? pace_->rate(now) : 0;
}

void Session::finish() {
  if (idle_) close();
}

void Session::close() {
  error_code ignored;
  socket_.shutdown(tcp::socket::shutdown_both, ignored);
  socket_.close(ignored);
  shared_.connections.leave(*this);
}

/// Waits until a request begins.
void Session::await_request() {
  if (buffer_.size() > 0) return read_request();
  buffer_.shrink_to_fit();
  socket_.async_wait(tcp::socket::wait_read, [self = shared_from_this()](error_code error) {
    if (error) return self->close();
    self->read_request();
  });
}

void Session::read_request() {
  idle_ = false;
  began_ = Clock::now();
  shared_.connections.becomes_busy(*this);
  parser_.emplace();
  parser_->header_limit(longest_header);
  http::async_read_header(socket_, buffer_, *parser_,
                          [self = shared_from_this()](error_code error, size_t) { self->on_header(error); });
}

void Session::on_header(error_code error) {
  if (!socket_.is_open()) return;
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return send(answer_text(431, "the request's header is too long\n"), false);
  if (error.category() == http::make_error_code(http::error::bad_target).category() &&
      error != http::error::end_of_stream && error != http::error::partial_message)
    return send(answer_text(400, "bad request\n"), false);
  if (error) return close();
  const auto& request = parser_->get();
  if (!names_one_host(request)) return send(answer_text(400, "a request has one Host\n"), false);
  const RequestHead head = head_of(request);
  // A request with a body is answered and the connection closed, so the body need not be read.
  const bool keep_alive = request.keep_alive() && parser_->is_done();
  parser_.reset();
  send(answer(head), keep_alive);
}

/// Without a descriptor for a file an idle connection gives its own.
Answer Session::answer(const RequestHead& request) {
  if (!shared_.rate.allows(peer(), Clock::now())) {
    Answer refusal = answer_text(429, "too many requests\n");
    refusal.add("Retry-After", "1");
    return refusal;
  }
  Answer answer = answer_request(shared_.catalog, request);
  if (answer.status == 503 && shared_.connections.close_an_idle_one())
    answer = answer_request(shared_.catalog, request);
  return answer;
}

void Session::send(Answer answer, bool keep_alive) {
  answer_ = std::move(answer);
  keep_alive_ = keep_alive && !shared_.stopping;
  head_ = head_text(answer_, keep_alive_);
  head_sent_ = 0;
  sent_ = 0;
  answer_.fields = {};
  if (!answer_.has_body) answer_.length = 0;
  pace_.emplace(Clock::now(), shared_.options.slow);
  send_more();
}

/// Sends what the socket takes, then waits until it takes more.
void Session::send_more() {
  size_t turn = 0;
  while ((head_sent_ < head_.size() || answer_.length > 0) && turn < longest_turn) {
    const ssize_t sent = send_some(longest_turn - turn);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0 && errno == EAGAIN) break;
    if (sent <= 0) return close();  // the client has gone, or the file has become shorter
    turn += static_cast<size_t>(sent);
    sent_ += static_cast<uint64_t>(sent);
  }
  if (head_sent_ == head_.size() && answer_.length == 0) return next_request();
  socket_.async_wait(tcp::socket::wait_write, [self = shared_from_this()](error_code error) {
    if (error) return self->close();
    self->send_more();
  });
}

/// Hands the system the next bytes of the head, or then of the body. Returns what ::send does.
ssize_t Session::send_some(size_t most) {
  const int socket = socket_.native_handle();
  if (head_sent_ < head_.size()) {
    const int more = answer_.length > 0 ? MSG_MORE : 0;
    const ssize_t sent = ::send(socket, head_.data() + head_sent_, head_.size() - head_sent_, MSG_NOSIGNAL | more);
    head_sent_ += static_cast<size_t>(std::max<ssize_t>(sent, 0));
    return sent;
  }
  most = std::min<uint64_t>(most, answer_.length);
  off_t offset = static_cast<off_t>(answer_.first);
  const ssize_t sent = answer_.file.is_open()
                           ? ::sendfile(socket, answer_.file.descriptor(), &offset, most)
                           : ::send(socket, answer_.text->data() + answer_.first, most, MSG_NOSIGNAL);
  answer_.first += static_cast<uint64_t>(std::max<ssize_t>(sent, 0));
  answer_.length -= static_cast<uint64_t>(std::max<ssize_t>(sent, 0));
  return sent;
}

void Session::next_request() {
  answer_ = {};
  head_ = {};
  pace_.reset();
  idle_end_ = Clock::now() + shared_.options.idle;
  if (shared_.stopping) return close();
  if (!keep_alive_) return close_gently();
  idle_ = true;
  shared_.connections.becomes_idle(*this);
  await_request();
}

/// Closes once the client has, or after a while, so that it can read what is on its way.
void Session::close_gently() {
  error_code ignored;
  socket_.shutdown(tcp::socket::shutdown_send, ignored);
  idle_ = true;
  idle_end_ = Clock::now() + std::min<Clock::duration>(lingering, shared_.options.idle);
  shared_.connections.becomes_idle(*this);
  drain();
}

void Session::drain() {
  buffer_.clear();
  socket_.async_read_some(buffer_.prepare(longest_header), [self = shared_from_this()](error_code error, size_t) {
    if (error) return self->close();
    self->drain();
  });
}

}  // namespace lightwell
