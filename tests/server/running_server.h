// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <map>
#include <string>
#include <thread>

#include "lightwell/server/server.h"
#include "tests/pack/pack_samples.h"
#include "tests/temporary_folder.h"

namespace lightwell {

/// A server on a free port in a thread of its own, stopped at the end.
class RunningServer {
 public:
  explicit RunningServer(ServerOptions options)
      : server_(listen(std::move(options))), thread_([this] { server_.run(); }) {}
  ~RunningServer() {
    server_.stop();
    thread_.join();
  }

  uint16_t port() const { return server_.port(); }
  Server& server() { return server_; }

 private:
  static Server listen(ServerOptions options) {
    options.port = 0;
    return std::move(Server::listen(options).value());
  }

  Server server_;
  std::thread thread_;
};

/// A pack of no streams with a little more than `length` bytes, no two parts of which are alike.
inline std::string pack_of(size_t length) {
  Random random(1, length);
  const std::vector<uint8_t> pack = make_pack(random_bytes(random, length), {});
  return {pack.begin(), pack.end()};
}

/// An answer as it came over the wire.
struct RawResponse {
  int status = 0;
  std::map<std::string, std::string> fields;  ///< names in lower case
  std::string body;
};

/// A plain socket to a port of this machine; reads give up after five seconds.
class RawConnection {
 public:
  explicit RawConnection(uint16_t port, const char* from = "127.0.0.1")
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    EXPECT_EQ(::inet_pton(AF_INET, from, &own.sin_addr), 1);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&own), sizeof own), 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{5, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;
  ~RawConnection() { ::close(socket_); }

  void send(std::string_view text) { ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL); }

  /// Reads one answer. Status 0 when the connection ends before its head is there.
  RawResponse receive(bool has_body = true) {
    RawResponse response;
    size_t end;
    while ((end = pending_.find("\r\n\r\n")) == std::string::npos)
      if (!read_more()) return response;
    parse_head(pending_.substr(0, end + 2), response);
    pending_.erase(0, end + 4);
    const auto length = response.fields.find("content-length");
    if (!has_body || length == response.fields.end()) return response;
    while (pending_.size() < std::stoul(length->second))
      if (!read_more()) break;
    response.body = pending_.substr(0, std::stoul(length->second));
    pending_.erase(0, response.body.size());
    return response;
  }

  RawResponse get(const std::string& target, const std::string& fields = "", const std::string& method = "GET") {
    send(method + " " + target + " HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n");
    return receive(method != "HEAD");
  }

  /// Reads so many bytes, fewer when the connection ends or the patience does.
  std::string read(size_t bytes) {
    while (pending_.size() < bytes)
      if (!read_more(bytes - pending_.size())) break;
    const std::string front = pending_.substr(0, bytes);
    pending_.erase(0, front.size());
    return front;
  }

  /// True when the other side closes within the patience.
  bool ended() {
    while (read_more()) pending_.clear();
    return last_read_ == 0 || errno == ECONNRESET;
  }

 private:
  bool read_more(size_t most = 65536) {
    char bytes[65536];
    last_read_ = ::recv(socket_, bytes, std::min(most, sizeof bytes), 0);
    if (last_read_ > 0) pending_.append(bytes, static_cast<size_t>(last_read_));
    return last_read_ > 0;
  }

  static void parse_head(const std::string& head, RawResponse& response) {
    response.status = std::stoi(head.substr(head.find(' ') + 1));
    for (size_t at = head.find("\r\n") + 2; at < head.size();) {
      const size_t end = head.find("\r\n", at), colon = head.find(": ", at);
      std::string name = head.substr(at, colon - at);
      for (char& c : name) c = static_cast<char>(std::tolower(c));
      response.fields[name] = head.substr(colon + 2, end - colon - 2);
      at = end + 2;
    }
  }

  int socket_;
  std::string pending_;
  ssize_t last_read_ = 0;
};

}  // namespace lightwell
