// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/server.h"

#include <sys/eventfd.h>
#include <sys/sendfile.h>

#include <algorithm>
#include <csignal>
#include <optional>
#include <set>

#include "lightwell/base/beast.h"
#include "lightwell/server/response.h"

namespace lightwell {
namespace {

constexpr size_t longest_header = 8192;
constexpr size_t least_progress = 16384;   // bytes that a client has to take in ServerOptions::slow
constexpr size_t longest_turn = 1u << 20;  // bytes sent for one connection before the others have their turn

class Session;

/// "127.0.0.1:8080", "[::1]:8080" (RFC 3986, 3.2.2).
std::string authority(const std::string& address, uint16_t port) {
  const std::string host = address.find(':') == std::string::npos ? address : "[" + address + "]";
  return host + ":" + std::to_string(port);
}

/// A request names its host once; of HTTP/1.0 it need not (RFC 9112, 3.2).
bool names_one_host(const http::request<http::empty_body>& request) {
  const size_t hosts = request.count(http::field::host);
  return hosts == 1 || (hosts == 0 && request.version() < 11);
}

/// The part of a server that its sessions share.
struct Shared {
  Catalog& catalog;
  const ServerOptions& options;
  std::set<Session*> sessions;
  bool stopping = false;
  std::function<void()> left;  ///< called when a session has gone
};

/// One connection: requests and their answers in turn. The handlers that wait for it keep it alive.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(tcp::socket socket, Shared& shared)
      : shared_(shared), socket_(std::move(socket)), deadline_(socket_.get_executor()), buffer_(longest_header) {
    shared_.sessions.insert(this);
  }
  ~Session() {
    shared_.sessions.erase(this);
    shared_.left();
  }

  void start() {
    error_code ignored;
    socket_.set_option(tcp::no_delay(true), ignored);
    socket_.native_non_blocking(true, ignored);
    read_request();
  }

  /// Closes the connection now if no answer is under way, else after it.
  void finish() {
    if (reading_) close();
  }
  void close() {
    error_code ignored;
    socket_.shutdown(tcp::socket::shutdown_both, ignored);
    socket_.close(ignored);
    deadline_.cancel(ignored);
  }

 private:
  void set_deadline(std::chrono::milliseconds time) {
    deadline_.expires_after(time);
    deadline_.async_wait([weak = weak_from_this()](error_code error) {
      if (const auto self = weak.lock(); self && !error) self->close();
    });
  }

  void read_request() {
    parser_.emplace();
    parser_->header_limit(longest_header);
    set_deadline(shared_.options.idle);
    reading_ = true;
    http::async_read_header(socket_, buffer_, *parser_, [self = shared_from_this()](error_code error, size_t) {
      self->reading_ = false;
      self->on_header(error);
    });
  }

  void on_header(error_code error) {
    if (!socket_.is_open()) return;
    if (error == http::error::header_limit || error == http::error::buffer_overflow)
      return send(answer_text(431, "the request's header is too long\n"), false);
    if (error.category() == http::make_error_code(http::error::bad_target).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message)
      return send(answer_text(400, "bad request\n"), false);
    if (error) return close();
    const auto& request = parser_->get();
    const auto field = [&](http::field name) { return std::string(request[name].data(), request[name].size()); };
    if (!names_one_host(request)) return send(answer_text(400, "a request has one Host\n"), false);
    const RequestHead head{std::string(request.method_string()), std::string(request.target()),
                           field(http::field::range), field(http::field::if_range), field(http::field::if_none_match)};
    // A request with a body is answered and the connection closed, so the body need not be read.
    send(answer_request(shared_.catalog, head), request.keep_alive() && parser_->is_done());
  }

  void send(Answer answer, bool keep_alive) {
    answer_ = std::move(answer);
    head_.emplace();
    head_->result(static_cast<unsigned>(answer_.status));
    head_->version(11);
    head_->set(http::field::server, "lightwell");
    for (const auto& [name, value] : answer_.fields) head_->set(name, value);
    head_->keep_alive(keep_alive && !shared_.stopping);
    if (answer_.status != 204 && answer_.status != 304) head_->content_length(answer_.length);
    serializer_.emplace(*head_);
    set_deadline(shared_.options.slow);
    http::async_write_header(socket_, *serializer_, [self = shared_from_this()](error_code error, size_t) {
      if (error) return self->close();
      self->send_body();
    });
  }

  void send_body() {
    if (!answer_.has_body) return next_request();
    if (answer_.file.is_open()) return send_file();
    asio::async_write(socket_, asio::buffer(answer_.text), [self = shared_from_this()](error_code error, size_t) {
      if (error) return self->close();
      self->next_request();
    });
  }

  /// Sends what the socket takes of the file, then waits until it takes more.
  void send_file() {
    size_t turn = 0;
    while (answer_.length > 0 && turn < longest_turn) {
      off_t offset = static_cast<off_t>(answer_.first);
      const ssize_t sent = ::sendfile(socket_.native_handle(), answer_.file.descriptor(), &offset,
                                      std::min<uint64_t>(answer_.length, longest_turn - turn));
      if (sent < 0 && errno == EINTR) continue;
      if (sent < 0 && errno == EAGAIN) break;
      if (sent <= 0) return close();  // the client has gone, or the file has become shorter
      answer_.first += static_cast<uint64_t>(sent);
      answer_.length -= static_cast<uint64_t>(sent);
      turn += static_cast<size_t>(sent);
    }
    if (answer_.length == 0) return next_request();
    progress_ += turn;
    if (progress_ >= least_progress) {
      progress_ = 0;
      set_deadline(shared_.options.slow);
    }
    socket_.async_wait(tcp::socket::wait_write, [self = shared_from_this()](error_code error) {
      if (error) return self->close();
      self->send_file();
    });
  }

  void next_request() {
    answer_ = {};
    progress_ = 0;
    if (shared_.stopping) return close();
    return head_->keep_alive() ? read_request() : close_gently();
  }

  /// Closes once the client has, or after a while, so that it can read what is on its way.
  void close_gently() {
    error_code ignored;
    socket_.shutdown(tcp::socket::shutdown_send, ignored);
    set_deadline(std::min(shared_.options.grace, shared_.options.idle));
    drain();
  }
  void drain() {
    buffer_.clear();
    socket_.async_read_some(buffer_.prepare(longest_header), [self = shared_from_this()](error_code error, size_t) {
      if (error) return self->close();
      self->drain();
    });
  }

  Shared& shared_;
  tcp::socket socket_;
  asio::steady_timer deadline_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<http::response<http::empty_body>> head_;
  std::optional<http::response_serializer<http::empty_body>> serializer_;
  Answer answer_;
  size_t progress_ = 0;  ///< bytes taken since the deadline was set
  bool reading_ = false;
};

}  // namespace

class Server::Loop {
 public:
  Loop(const ServerOptions& options, Catalog catalog)
      : options_(options), catalog_(std::move(catalog)), shared_{catalog_, options_, {}, false, [this] {
                                                                   on_left();
                                                                 }} {}

  /// Sessions that are left are destroyed with io_, when nothing that they could report to is left.
  ~Loop() {
    shared_.left = [] {};
  }

  Result<void> listen() {
    error_code error;
    const auto address = asio::ip::make_address(options_.bind == "localhost" ? "127.0.0.1" : options_.bind, error);
    if (error) return fail(options_.bind, "is neither an IP address nor localhost");
    const tcp::endpoint endpoint(address, options_.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(tcp::acceptor::max_listen_connections, error);
    if (!error) port_ = acceptor_.local_endpoint(error).port();
    if (error) {
      const std::string hint = error == asio::error::address_in_use ? "; --port 0 takes a free one" : "";
      return fail(ErrorKind::io, authority(options_.bind, options_.port), error.message() + hint);
    }
    stop_event_.assign(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), error);
    if (error) return fail(ErrorKind::io, "server", error.message());
    std::signal(SIGPIPE, SIG_IGN);
    return {};
  }

  uint16_t port() const { return port_; }
  std::string url() const { return "http://" + authority(options_.bind, port_) + "/"; }
  Catalog& catalog() { return catalog_; }

  void run() {
    stop_event_.async_wait(asio::posix::stream_descriptor::wait_read, [this](error_code) { begin_stop(); });
    accept();
    io_.run();
  }

  void stop() {
    const uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(stop_event_.native_handle(), &one, sizeof one);
  }

 private:
  void accept() {
    if (shared_.stopping || accepting_ || shared_.sessions.size() >= options_.max_connections) return;
    accepting_ = true;
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      accepting_ = false;
      if (shared_.stopping) return;
      if (!error) std::make_shared<Session>(std::move(socket), shared_)->start();
      if (!error) return accept();
      // No descriptors are left: some may be free again soon.
      pause_.expires_after(std::chrono::milliseconds(100));
      pause_.async_wait([this](error_code cancelled) {
        if (!cancelled) accept();
      });
    });
  }

  void on_left() {
    if (shared_.stopping) return end_if_empty();
    accept();
  }

  void begin_stop() {
    shared_.stopping = true;
    error_code ignored;
    acceptor_.close(ignored);
    const std::vector<Session*> sessions(shared_.sessions.begin(), shared_.sessions.end());
    for (Session* session : sessions) session->finish();
    pause_.expires_after(options_.grace);
    pause_.async_wait([this](error_code) { io_.stop(); });
    end_if_empty();
  }

  void end_if_empty() {
    if (shared_.sessions.empty()) pause_.cancel();
  }

  ServerOptions options_;
  Catalog catalog_;
  Shared shared_;
  asio::io_context io_{1};
  tcp::acceptor acceptor_{io_};
  asio::posix::stream_descriptor stop_event_{io_};
  asio::steady_timer pause_{io_};
  bool accepting_ = false;
  uint16_t port_ = 0;
};

Result<Server> Server::listen(const ServerOptions& options) {
  LW_TRY(catalog, Catalog::open(options.packs, options.page));
  auto loop = std::make_unique<Loop>(options, std::move(catalog));
  LW_CHECK(loop->listen());
  return Server(std::move(loop));
}

Server::Server(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;
Server::~Server() = default;

uint16_t Server::port() const { return loop_->port(); }
std::string Server::url() const { return loop_->url(); }
Catalog& Server::catalog() { return loop_->catalog(); }
void Server::run() { loop_->run(); }
void Server::stop() { loop_->stop(); }

}  // namespace lightwell
