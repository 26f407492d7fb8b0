// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/server.h"

#include <sys/eventfd.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "lightwell/base/beast.h"
#include "lightwell/server/session.h"

namespace lightwell {
namespace {

/// "127.0.0.1:8080", "[::1]:8080" (RFC 3986, 3.2.2).
std::string authority(const std::string& address, uint16_t port) {
  const std::string host = address.find(':') == std::string::npos ? address : "[" + address + "]";
  return host + ":" + std::to_string(port);
}

/// Lets the process have as many descriptors as that number of connections needs, two each, and says how many
/// connections it can have then.
size_t provide_descriptors(size_t connections) {
  constexpr size_t for_others = 64;
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return connections;
  const rlim_t wanted = 2 * static_cast<rlim_t>(connections) + for_others;
  if (limit.rlim_cur < wanted) {
    limit.rlim_cur = std::min(wanted, limit.rlim_max);
    ::setrlimit(RLIMIT_NOFILE, &limit);
    ::getrlimit(RLIMIT_NOFILE, &limit);
  }
  const rlim_t possible = limit.rlim_cur > 2 * for_others ? (limit.rlim_cur - for_others) / 2 : for_others / 2;
  return std::min<rlim_t>(connections, possible);
}

}  // namespace

class Server::Loop {
 public:
  Loop(const ServerOptions& options, Catalog catalog)
      : options_(options),
        catalog_(std::move(catalog)),
        connections_({provide_descriptors(options.max_connections), options.connections_per_address}),
        rate_(options.requests_per_second) {}

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
    if (!error) acceptor_.non_blocking(true, error);
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
    await_stop();
    await_client();
    look_for_the_late();
    io_.run();
  }

  void stop() {
    const uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(stop_event_.native_handle(), &one, sizeof one);
  }

 private:
  void await_client() {
    if (shared_.stopping || awaiting_) return;
    awaiting_ = true;
    acceptor_.async_wait(tcp::acceptor::wait_read, [this](error_code) {
      awaiting_ = false;
      if (!shared_.stopping) admit();
    });
  }

  /// Lets the next client in, who waits. Without room for it this is tried again when one leaves, and soon.
  void admit() {
    if (!connections_.make_room()) return;
    error_code error;
    tcp::endpoint client;
    tcp::socket socket = acceptor_.accept(client, error);
    const bool exhausted = error == asio::error::no_descriptors || error == std::errc::too_many_files_open_in_system ||
                           error == asio::error::no_memory || error == asio::error::no_buffer_space;
    if (exhausted && !connections_.close_an_idle_one()) return;
    if (!error && connections_.make_room_of(peer_of(client.address())))
      std::make_shared<Session>(std::move(socket), peer_of(client.address()), shared_)->start();
    await_client();
  }

  /// Now and then closes those whose time is up.
  void look_for_the_late() {
    using std::chrono::milliseconds;
    const milliseconds shortest = std::min(options_.idle, options_.slow);
    pause_.expires_after(std::clamp(shortest / 8, milliseconds(5), milliseconds(1000)));
    pause_.async_wait([this](error_code cancelled) {
      if (cancelled) return;
      const auto now = Connection::Clock::now();
      connections_.close_the_late(now);
      rate_.forget(now);
      await_client();
      look_for_the_late();
    });
  }

  void on_left() {
    if (shared_.stopping) return end_if_empty();
    await_client();
  }

  void await_stop() {
    stop_event_.async_wait(asio::posix::stream_descriptor::wait_read, [this](error_code) {
      uint64_t times = 0;
      [[maybe_unused]] const ssize_t read = ::read(stop_event_.native_handle(), &times, sizeof times);
      if (shared_.stopping || times > 1) return io_.stop();
      begin_stop();
      await_stop();
    });
  }

  void begin_stop() {
    shared_.stopping = true;
    error_code ignored;
    acceptor_.close(ignored);
    connections_.finish();
    end_.expires_after(options_.grace);
    end_.async_wait([this](error_code) { io_.stop(); });
    end_if_empty();
  }

  void end_if_empty() {
    if (connections_.empty()) end_.cancel();
  }

  ServerOptions options_;
  Catalog catalog_;
  Connections connections_;
  RequestRate rate_;
  Shared shared_{catalog_, options_, connections_, rate_, false, [this] { on_left(); }};
  asio::io_context io_{1};
  tcp::acceptor acceptor_{io_};
  asio::posix::stream_descriptor stop_event_{io_};
  asio::steady_timer pause_{io_}, end_{io_};
  bool awaiting_ = false;
  uint16_t port_ = 0;
};

Result<Server> Server::listen(const ServerOptions& options) {
  LW_TRY(catalog, Catalog::open(options.packs, options.page, options.packs_change));
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
