// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lightwell/server/connections.h"
#include "lightwell/server/pace.h"
#include "lightwell/server/request_rate.h"
#include "lightwell/server/response.h"
#include "lightwell/server/server.h"

namespace lightwell {

/// The part of a server that its sessions share.
struct Shared {
  Catalog& catalog;
  const ServerOptions& options;
  Connections& connections;
  RequestRate& rate;
  bool stopping = false;
  std::function<void()> left = {};  ///< called when a session has gone
};

/// One connection: requests and their answers in turn. The handlers that wait for it keep it alive. While it waits for
/// a request it holds no memory but its own.
class Session final : public Connection, public std::enable_shared_from_this<Session> {
 public:
  Session(tcp::socket socket, const Peer& peer, Shared& shared);
  ~Session() override;

  void start();
  Clock::time_point deadline(Clock::time_point now) override;
  std::optional<double> rate(Clock::time_point now) const override;
  void finish() override;
  void close() override;

 private:
  void await_request();
  void read_request();
  void on_header(error_code error);
  Answer answer(const RequestHead& request);
  void send(Answer answer, bool keep_alive);
  void send_more();
  ssize_t send_some(size_t most);
  void next_request();
  void close_gently();
  void drain();

  Shared& shared_;
  tcp::socket socket_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  Clock::time_point idle_end_;
  Clock::time_point began_;   ///< when the request under way did
  std::optional<Pace> pace_;  ///< while an answer is sent
  std::string head_;          ///< of the answer
  size_t head_sent_ = 0;
  Answer answer_;
  uint64_t sent_ = 0;
  bool idle_ = true;
  bool keep_alive_ = false;
};

}  // namespace lightwell
