// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lightwell/base/result.h"
#include "lightwell/server/catalog.h"

namespace lightwell {

/// What a server serves, where, and what it puts up with.
struct ServerOptions {
  std::string bind = "127.0.0.1";            ///< an IPv4 or IPv6 address, or localhost, which is this one
  uint16_t port = 8080;                      ///< 0: any free one
  std::vector<std::filesystem::path> packs;  ///< files, or folders of *.glb
  std::filesystem::path page;                ///< the folder with the page's index.html; empty: no page
  bool packs_change = false;                 ///< the page is to look out for packs that are replaced
  /// Beyond these, in all and of one address, an idle connection is closed for a new one, else the one that takes its
  /// answer slowest. Where all are fast, new ones wait. 0 of one address is any number.
  size_t max_connections = 8192, connections_per_address = 1024;
  uint32_t requests_per_second = 0;       ///< of one address; beyond it the status is 429. 0: any number
  std::chrono::milliseconds idle{60000};  ///< for a whole request header, from the end of the response before it
  std::chrono::milliseconds slow{30000};  ///< for every 16 KB that a client has to take (see Pace)
  std::chrono::milliseconds grace{5000};  ///< for responses under way when the server is stopped
};

/// An HTTP/1.1 server for packs and the page: GET and HEAD, byte ranges, strong ETags and CORS; the page's files
/// gzipped for who accepts that. One thread, asynchronous; bodies of files go out by sendfile, so that a connection
/// needs a few kilobytes whatever it downloads. TLS and HTTP/2 are left to a proxy.
///
///   /             the page, /... its files
///   /packs/NAME   a pack
///   /packs.json   the list of packs
///   /healthz      "ok"
class Server {
 public:
  /// Opens the port. The process ignores SIGPIPE from then on, and may have as many descriptors as are needed for
  /// max_connections; where the system allows fewer, there are fewer connections.
  static Result<Server> listen(const ServerOptions& options);
  Server(Server&&) noexcept;
  Server& operator=(Server&&) noexcept;
  ~Server();

  /// The port that is listened on.
  uint16_t port() const;
  /// The address of the page: "http://127.0.0.1:8080/", an IPv6 address in brackets.
  std::string url() const;
  /// What it serves. Not to be used while run() runs.
  Catalog& catalog();
  /// Serves until stop() is called.
  void run();
  /// Ends run(): no new connection, idle ones are closed, responses under way are finished within the time of grace; a
  /// second call ends it at once. May be called from any thread and from a signal handler.
  void stop();

 private:
  class Loop;
  explicit Server(std::unique_ptr<Loop> loop);
  std::unique_ptr<Loop> loop_;
};

}  // namespace lightwell
