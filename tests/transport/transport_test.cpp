// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <deque>
#include <thread>

#include "lightwell/transport/fetch.h"
#include "tests/client/received_scene.h"
#include "tests/client/sample_pack.h"

namespace lightwell {
namespace {

const std::vector<uint8_t>& sample() {
  static const std::vector<uint8_t> pack = sample_pack(sample_scene(8000, 12));
  return pack;
}

/// Fetches over a transport and compares with the pack's scene.
FetchOutcome expect_exact(Transport& transport) {
  Client client({});
  ReceivedScene scene;
  const auto outcome = fetch(client, transport, [&](const Update& update) { EXPECT_EQ(scene.apply(update), ""); });
  EXPECT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(scene == decode_directly(sample()));
  return outcome.value_or(FetchOutcome{});
}

TEST(Fetch, FromMemory) {
  const auto transport = memory_transport(sample());
  const FetchOutcome outcome = expect_exact(*transport);
  EXPECT_EQ(outcome.bytes, sample().size());
  EXPECT_EQ(outcome.timeline.back().bytes, sample().size());
  EXPECT_LE(outcome.first_picture.bytes, 65536u) << "the first picture needs one request";
  EXPECT_GT(outcome.first_picture.faces, 0u);
  EXPECT_GE(outcome.first_picture.nodes, 8u);
}

TEST(Fetch, ALineTakesTheTimeOfItsRateAndLatency) {
  const auto transport = shaped_transport(memory_transport(sample()), {.bits_per_second = 8e5, .latency = 0.2});
  const FetchOutcome outcome = expect_exact(*transport);
  const double transfer = static_cast<double>(sample().size()) * 8 / 8e5;
  constexpr double rounding = 1e-9;  // of the sum over the pieces that arrive
  EXPECT_GE(outcome.seconds, transfer + 0.2 - rounding);
  // The request for the opening and the one that follows it wait for their answers; all others overlap.
  EXPECT_LE(outcome.seconds, transfer + 4 * 0.2 + 0.5);
  for (size_t i = 1; i < outcome.timeline.size(); i++) {
    EXPECT_GE(outcome.timeline[i].seconds, outcome.timeline[i - 1].seconds);
    EXPECT_GE(outcome.timeline[i].bytes, outcome.timeline[i - 1].bytes);
    EXPECT_GE(outcome.timeline[i].faces, outcome.timeline[i - 1].faces);
  }
}

TEST(Fetch, FailuresAreErrors) {
  std::vector<uint8_t> damaged = sample();
  damaged[30] ^= 1;
  const auto transport = memory_transport(damaged);
  Client client({});
  const auto unreadable = fetch(client, *transport, [](const Update&) {});
  ASSERT_FALSE(unreadable);
  EXPECT_EQ(unreadable.error().kind, ErrorKind::bad_input);
  Client other({});
  const auto again = memory_transport(sample());
  const auto cancelled = fetch(other, *again, [](const Update&) {}, {.cancelled = [] { return true; }});
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, ErrorKind::cancelled);
}

/// A line on which requests get no answer, by and by: the first ones fail, are told to come back, or hear nothing.
class BadLine final : public Transport {
 public:
  enum class Fault { refused, busy, silent };
  BadLine(Fault fault, uint32_t requests) : fault_(fault), left_(requests) {}

  double now() override { return good_->now(); }
  void ask(uint32_t request, uint64_t first, uint64_t last) override {
    if (left_ == 0) return good_->ask(request, first, last);
    left_--;
    using Kind = TransportEvent::Kind;
    if (fault_ == Fault::refused) events_.push_back({Kind::failed, request, 0, {}, {}, {}, "Connection refused"});
    if (fault_ == Fault::busy) events_.push_back({Kind::head, request, 503, {}, {}, {}});
  }
  void cancel(uint32_t request) override { good_->cancel(request); }
  std::optional<TransportEvent> wait(double until) override {
    if (events_.empty()) return good_->wait(until);
    const TransportEvent event = events_.front();
    events_.pop_front();
    return event;
  }

 private:
  std::unique_ptr<Transport> good_ = memory_transport(sample());
  std::deque<TransportEvent> events_;
  Fault fault_;
  uint32_t left_;
};

TEST(Fetch, AnOutageIsToldOnceAndSurvived) {
  using Fault = BadLine::Fault;
  for (const auto& [fault, reason] :
       {std::pair(Fault::refused, "Connection refused"), std::pair(Fault::busy, "the server answers 503"),
        std::pair(Fault::silent, "the server does not answer")}) {
    BadLine line(fault, 4);
    Client client({});
    std::vector<std::string> told;
    const auto tell = [&](const std::string& text) { told.push_back(text); };
    EXPECT_TRUE(fetch(client, line, [](const Update&) {}, {.outage = tell}));
    EXPECT_EQ(told, std::vector<std::string>{reason});
  }
}

TEST(Fetch, PatienceEndsWithWhatWasWrong) {
  using Fault = BadLine::Fault;
  for (const auto& [fault, reason] : {std::pair(Fault::refused, "Connection refused; gave up after 40 s"),
                                      std::pair(Fault::busy, "the server answers 503; gave up after 40 s"),
                                      std::pair(Fault::silent, "the server does not answer; gave up after 40 s")}) {
    BadLine line(fault, 1000);
    Client client({});
    const auto outcome = fetch(client, line, [](const Update&) {}, {.patience = 40});
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().reason, reason);
    EXPECT_EQ(outcome.error().kind, ErrorKind::io);
    EXPECT_NEAR(line.now(), 40, 1e-6) << "neither sooner nor later";
  }
}

/// A file server of one thread and a connection at a time, which closes each connection after a few answers.
class TinyServer {
 public:
  explicit TinyServer(Bytes file) : file_(file), socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(socket_, 16), 0);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~TinyServer() {
    ::shutdown(socket_, SHUT_RDWR);
    thread_.join();
    ::close(socket_);
  }

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/pack.glb"; }

 private:
  void serve() {
    for (int connection; (connection = ::accept(socket_, nullptr, nullptr)) >= 0; ::close(connection)) {
      const timeval patience{0, 50000};  // an idle connection must not keep the others waiting
      ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
      for (int answers = 0; answers < 3 && answer(connection); answers++) {
      }
    }
  }

  bool answer(int connection) {
    std::string request;
    char byte;
    while (!request.ends_with("\r\n\r\n")) {
      if (::recv(connection, &byte, 1, 0) != 1) return false;
      request += byte;
    }
    unsigned long first = 0, last = 0;
    const size_t range = request.find("Range: bytes=");
    if (range == std::string::npos || std::sscanf(request.c_str() + range, "Range: bytes=%lu-%lu", &first, &last) != 2)
      return false;
    last = std::min(last, file_.size() - 1);
    const std::string head = "HTTP/1.1 206 Partial Content\r\nETag: \"x\"\r\nContent-Range: bytes " +
                             std::to_string(first) + "-" + std::to_string(last) + "/" + std::to_string(file_.size()) +
                             "\r\nContent-Length: " + std::to_string(last + 1 - first) + "\r\n\r\n";
    return send_all(connection, as_bytes(head)) && send_all(connection, file_.subspan(first, last + 1 - first));
  }

  static bool send_all(int connection, Bytes bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(connection, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes = bytes.subspan(static_cast<size_t>(sent));
    }
    return true;
  }

  Bytes file_;
  int socket_;
  uint16_t port_ = 0;
  std::thread thread_;
};

TEST(HttpTransport, StreamsFromAServerThatClosesItsConnections) {
  TinyServer server(sample());
  const auto transport = http_transport(server.url());
  ASSERT_TRUE(transport) << transport.error().message();
  expect_exact(**transport);
}

TEST(HttpTransport, NobodyThereIsAFailedRequest) {
  const auto transport = http_transport("http://127.0.0.1:1/pack.glb");
  ASSERT_TRUE(transport);
  (*transport)->ask(7, 0, 99);
  const auto event = (*transport)->wait(5);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, TransportEvent::Kind::failed);
  EXPECT_EQ(event->request, 7u);
  EXPECT_EQ(event->reason, "Connection refused");
}

// A signal that has a handler ends a system's wait before its time, which is none of the transport's business.
TEST(HttpTransport, ASignalDoesNotDisturbAWait) {
  const auto transport = http_transport("http://127.0.0.1:1/pack.glb");
  ASSERT_TRUE(transport);
  const auto before = std::signal(SIGALRM, [](int) {});
  const itimerval often{{0, 10000}, {0, 10000}}, never{};
  ::setitimer(ITIMER_REAL, &often, nullptr);
  const double until = (*transport)->now() + 0.2;
  EXPECT_FALSE((*transport)->wait(until));
  EXPECT_GE((*transport)->now(), until);
  ::setitimer(ITIMER_REAL, &never, nullptr);
  std::signal(SIGALRM, before);
}

TEST(HttpTransport, WrongUrlsAreErrors) {
  for (const char* url : {"", "pack.glb", "https://localhost/pack.glb", "http://", "http:///x", "http://localhost:/x",
                          "http://a b/", "http://localhost:65536/x", "http://localhost:http/x", "http://::1/x",
                          "http://[::1/x", "http://[::1]80/x", "http://[]/x"})
    EXPECT_FALSE(http_transport(url)) << url;
}

TEST(HttpTransport, UnderstandsIPv6Addresses) {
  for (const char* url : {"http://[::1]:1/pack.glb", "http://[::1]", "http://[2001:db8::1]:8080?x=1"})
    EXPECT_TRUE(http_transport(url)) << url;
}

}  // namespace
}  // namespace lightwell
