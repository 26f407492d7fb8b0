// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <map>

#include "lightwell/base/beast.h"
#include "lightwell/client/action.h"
#include "lightwell/transport/transport.h"

namespace lightwell {
namespace {

/// The parts of an http URL (RFC 3986, 3; RFC 9110, 4.2.1).
struct Url {
  std::string host;  ///< an IPv6 address without its brackets
  std::string port = "80";
  std::string authority;  ///< host and port as they stand in the URL: the field Host
  std::string target = "/";
};

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; }) &&
         std::stoul(std::string(text)) <= std::numeric_limits<uint16_t>::max();
}

std::optional<Url> parse_url(std::string_view text) {
  constexpr std::string_view scheme = "http://";
  if (!text.starts_with(scheme)) return std::nullopt;
  text.remove_prefix(scheme.size());
  Url url;
  text = text.substr(0, text.find('#'));
  const size_t end = std::min(text.find_first_of("/?"), text.size());
  url.authority = text.substr(0, end);
  const std::string_view authority = url.authority, rest = text.substr(end);
  url.target = (rest.starts_with('/') ? "" : "/") + std::string(rest);
  const bool bracketed = authority.starts_with('[');
  const size_t bracket = bracketed ? authority.find(']') : 0;
  if (bracket == std::string_view::npos) return std::nullopt;
  const size_t colon = std::min(authority.find(':', bracket), authority.size());
  if (bracketed && colon != bracket + 1) return std::nullopt;
  url.host = bracketed ? authority.substr(1, bracket - 1) : authority.substr(0, colon);
  if (colon < authority.size()) url.port = authority.substr(colon + 1);
  const bool printable = std::ranges::all_of(url.target, [](char c) { return c > ' ' && c < 0x7f; });
  if (url.host.empty() || !is_port(url.port) || !printable) return std::nullopt;
  return url;
}

/// Where a redirection leads: to another URL, or to another target of the same server.
std::optional<Url> redirected(const Url& from, std::string_view location) {
  if (!location.starts_with('/') || location.starts_with("//")) return parse_url(location);
  return parse_url("http://" + from.authority + std::string(location));
}

bool is_redirection(unsigned status) {
  return status == 301 || status == 302 || status == 303 || status == 307 || status == 308;
}

/// A server, and the events of the requests to it.
struct Exchange {
  asio::io_context io;
  /// Keeps io waiting until its time also when nothing is under way.
  asio::executor_work_guard<asio::io_context::executor_type> work = asio::make_work_guard(io);
  Url url;
  tcp::resolver::results_type addresses;
  std::deque<TransportEvent> events;
  int redirections = 0;

  /// Turns to another server or target from now on; false where that leads nowhere.
  bool follow(std::string_view location) {
    constexpr int most_redirections = 10;
    std::optional<Url> next = redirected(url, location);
    if (!next || ++redirections > most_redirections) return false;
    error_code error;
    tcp::resolver resolver(io);
    const auto found = resolver.resolve(next->host, next->port, error);
    if (error) return false;
    addresses = found;
    url = std::move(*next);
    return true;
  }
};

/// One connection, which carries one request at a time.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  explicit Connection(Exchange& exchange) : exchange_(exchange), socket_(exchange.io) {}

  bool idle() const { return !busy_ && socket_.is_open(); }
  bool dead() const { return !busy_ && !socket_.is_open(); }
  uint32_t request() const { return request_; }

  void start(uint32_t request, uint64_t first, uint64_t last) {
    request_ = request;
    first_ = first;
    last_ = last;
    busy_ = true;
    reused_ = socket_.is_open();
    question_ = {http::verb::get, exchange_.url.target, 11};
    question_.set(http::field::host, exchange_.url.authority);
    if (last != Action::to_the_end)
      question_.set(http::field::range, "bytes=" + std::to_string(first) + "-" + std::to_string(last));
    if (reused_)
      write();
    else
      connect();
  }

  /// Drops the request and the connection with it; no further event comes.
  void abandon() {
    busy_ = false;
    close();
  }

 private:
  void connect() {
    reused_ = false;
    socket_ = tcp::socket(exchange_.io);
    buffer_.clear();
    asio::async_connect(socket_, exchange_.addresses,
                        [self = shared_from_this()](error_code error, const tcp::endpoint&) {
                          if (error || !self->busy_) return self->failed(error);
                          error_code ignored;
                          self->socket_.set_option(tcp::no_delay(true), ignored);
                          self->write();
                        });
  }

  void write() {
    http::async_write(socket_, question_, [self = shared_from_this()](error_code error, size_t) {
      if (error) return self->failed_before_answer(error);
      self->read_head();
    });
  }

  void read_head() {
    parser_.emplace();
    parser_->body_limit(std::numeric_limits<uint64_t>::max());
    http::async_read_header(socket_, buffer_, *parser_, [self = shared_from_this()](error_code error, size_t) {
      if (error) return self->failed_before_answer(error);
      self->on_head();
    });
  }

  void on_head() {
    if (!busy_) return;
    const auto& head = parser_->get();
    if (is_redirection(head.result_int()) && exchange_.follow(std::string(head[http::field::location]))) {
      close();
      return start(request_, first_, last_);
    }
    TransportEvent event{TransportEvent::Kind::head, request_, static_cast<int>(head.result_int()), {}, {}, {}};
    // A part of what gzip makes of the file is no part of the file, whatever its range.
    const bool coded =
        !head[http::field::content_encoding].empty() && head[http::field::content_encoding] != "identity";
    event.content_range = coded ? "coded" : std::string(head[http::field::content_range]);
    event.etag = std::string(head[http::field::etag]);
    exchange_.events.push_back(std::move(event));
    read_body();
  }

  void read_body() {
    if (parser_->is_done()) return finished();
    parser_->get().body().data = piece_.data();
    parser_->get().body().size = piece_.size();
    http::async_read_some(socket_, buffer_, *parser_, [self = shared_from_this()](error_code error, size_t) {
      if (error && error != http::error::need_buffer) return self->failed(error);
      self->on_body();
    });
  }

  void on_body() {
    if (!busy_) return;
    const size_t length = piece_.size() - parser_->get().body().size;
    if (length > 0)
      exchange_.events.push_back({TransportEvent::Kind::bytes,
                                  request_,
                                  0,
                                  {},
                                  {},
                                  {piece_.begin(), piece_.begin() + static_cast<std::ptrdiff_t>(length)}});
    read_body();
  }

  void finished() {
    busy_ = false;
    exchange_.events.push_back({TransportEvent::Kind::end, request_, 0, {}, {}, {}});
    if (!parser_->keep_alive()) close();
  }

  /// Tries once more on a new connection when an idle one was used, since a server may close those at any moment.
  void failed_before_answer(error_code error) {
    if (busy_ && reused_) return connect();
    failed(error);
  }

  void failed(error_code error) {
    if (busy_) exchange_.events.push_back({TransportEvent::Kind::failed, request_, 0, {}, {}, {}, error.message()});
    abandon();
  }

  void close() {
    error_code ignored;
    socket_.close(ignored);
  }

  Exchange& exchange_;
  tcp::socket socket_;
  beast::flat_buffer buffer_;
  http::request<http::empty_body> question_;
  std::optional<http::response_parser<http::buffer_body>> parser_;
  std::array<uint8_t, 16384> piece_{};
  uint32_t request_ = 0;
  uint64_t first_ = 0, last_ = 0;
  bool busy_ = false;
  bool reused_ = false;
};

class HttpTransport final : public Transport {
 public:
  Result<void> open(Url url) {
    error_code error;
    tcp::resolver resolver(exchange_.io);
    exchange_.addresses = resolver.resolve(url.host, url.port, error);
    if (error) return fail(ErrorKind::io, url.host, error.message());
    exchange_.url = std::move(url);
    return {};
  }

  double now() override { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  void ask(uint32_t request, uint64_t first, uint64_t last) override {
    std::erase_if(connections_, [](const auto& connection) { return connection->dead(); });
    auto free = std::ranges::find_if(connections_, [](const auto& connection) { return connection->idle(); });
    if (free == connections_.end()) {
      connections_.push_back(std::make_shared<Connection>(exchange_));
      free = connections_.end() - 1;
    }
    (*free)->start(request, first, last);
  }

  void cancel(uint32_t request) override {
    std::erase_if(connections_, [&](const auto& connection) {
      if (connection->request() != request || connection->idle()) return false;
      connection->abandon();
      return true;
    });
    std::erase_if(exchange_.events, [&](const TransportEvent& event) { return event.request == request; });
  }

  std::optional<TransportEvent> wait(double until) override {
    while (exchange_.events.empty()) {
      const double left = std::clamp(until - now(), 0.0, 3600.0);
      // run_one_for() looks at nothing when no time is left, but what has come meanwhile is to be heard.
      const size_t ran = left > 0 ? exchange_.io.run_one_for(std::chrono::duration_cast<std::chrono::microseconds>(
                                        std::chrono::duration<double>(left)))
                                  : exchange_.io.poll_one();
      if (ran == 0 && now() >= until) return std::nullopt;
    }
    TransportEvent event = std::move(exchange_.events.front());
    exchange_.events.pop_front();
    return event;
  }

 private:
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Exchange exchange_;
  std::vector<std::shared_ptr<Connection>> connections_;
};

}  // namespace

Result<std::unique_ptr<Transport>> http_transport(const std::string& url) {
  std::optional<Url> parsed = parse_url(url);
  if (!parsed) return fail(url, "is not a URL of the form http://host:port/path");
  auto transport = std::make_unique<HttpTransport>();
  LW_CHECK(transport->open(std::move(*parsed)));
  return transport;
}

}  // namespace lightwell
