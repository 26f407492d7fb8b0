// SPDX-License-Identifier: Apache-2.0
//
// A server at its limits: too many clients, slow ones, no descriptors, and the end.
#include <fcntl.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>

#include "lightwell/server/pace.h"
#include "tests/address_sanitizer.h"
#include "tests/server/running_server.h"

namespace lightwell {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class ServerLimits : public testing::Test {
 protected:
  ServerLimits() {
    folder_.write("page/main.js", "js");
    folder_.write("packs/room.glb", pack_);
    options_.packs = {folder_.path() / "packs"};
    options_.page = folder_.path() / "page";
  }

  /// A pack that is more than the system's socket buffers hold.
  const std::string& write_large_pack() const {
    static const std::string large = pack_of(20 << 20);
    folder_.write("packs/large.glb", large);
    return large;
  }

  const std::string pack_ = pack_of(300000);
  TemporaryFolder folder_;
  ServerOptions options_;
};

constexpr const char* ask_for_large = "GET /packs/large.glb HTTP/1.1\r\nHost: x\r\n\r\n";

TEST_F(ServerLimits, SilentClientsAreDropped) {
  options_.idle = 100ms;
  RunningServer server(options_);
  RawConnection silent(server.port());
  RawConnection dripping(server.port());
  dripping.send("GET / HT");
  EXPECT_TRUE(silent.ended());
  EXPECT_TRUE(dripping.ended());
}

TEST_F(ServerLimits, AClientThatTakesNothingIsDropped) {
  options_.slow = 20ms;
  const std::string& large = write_large_pack();
  RunningServer server(options_);
  RawConnection stuck(server.port());
  stuck.send(ask_for_large);
  std::this_thread::sleep_for(options_.slow * (Pace::most_portions + 10));  // what its system has taken buys no more
  EXPECT_LT(stuck.receive().body.size(), large.size());
}

// It is the system that takes the bytes, in portions of its own: some hundred kilobytes on a loopback.
TEST_F(ServerLimits, AClientThatKeepsThePaceIsNotDropped) {
  options_.slow = 300ms;  // thrice what the client takes, which a busy machine may delay
  const std::string& large = write_large_pack();
  RunningServer server(options_);
  RawConnection slow(server.port());
  slow.send(ask_for_large);
  const auto end = Clock::now() + 5s;
  std::string received;
  while (Clock::now() < end) {
    received += slow.read(Pace::portion);
    std::this_thread::sleep_for(80ms);
  }
  const size_t total = received.find("\r\n\r\n") + 4 + large.size();
  received += slow.read(total - received.size());
  EXPECT_TRUE(received.ends_with(large)) << received.size() << " bytes of " << total;
}

TEST_F(ServerLimits, ManyClientsAtOnce) {
  options_.max_connections = 8;  // of whom is idle the connection may be closed at any time, as clients expect
  RunningServer server(options_);
  std::vector<std::thread> clients;
  for (int client = 0; client < 24; client++)
    clients.emplace_back([&, client] {
      auto connection = std::make_unique<RawConnection>(server.port());
      for (size_t i = 0; i < 20; i++) {
        const size_t first = (i * 7919 + static_cast<size_t>(client) * 104729) % 290000;
        const std::string range = "Range: bytes=" + std::to_string(first) + "-" + std::to_string(first + 4999) + "\r\n";
        RawResponse answer;
        for (int tries = 0; tries < 1000 && answer.status == 0; tries++) {
          answer = connection->get("/packs/room.glb", range);
          if (answer.status == 0) connection = std::make_unique<RawConnection>(server.port());
        }
        EXPECT_TRUE(answer.body == pack_.substr(first, 5000));
      }
    });
  for (std::thread& client : clients) client.join();
}

/// Memory of this process in bytes.
size_t resident() {
  size_t pages = 0;
  std::ifstream("/proc/self/statm").ignore(64, ' ') >> pages;
  return pages * static_cast<size_t>(::sysconf(_SC_PAGESIZE));
}

/// How many connections to ourselves the system allows, of those wanted.
size_t possible(size_t wanted) {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
  return std::min<size_t>(wanted, (limit.rlim_cur - 200) / 3);
}

/// The longest of some requests, each on a connection of its own.
std::chrono::duration<double> slowest_answer(uint16_t port) {
  std::chrono::duration<double> longest{};
  for (int i = 0; i < 20; i++) {
    const auto begin = Clock::now();
    RawConnection fresh(port);
    EXPECT_EQ(fresh.get("/packs/room.glb", "Range: bytes=0-999\r\n").body.size(), 1000u);
    longest = std::max<std::chrono::duration<double>>(longest, Clock::now() - begin);
  }
  return longest;
}

// Measured are 2 ms or less; a busy machine needs more.
constexpr std::chrono::duration<double> promptly = with_sanitizer * 500ms;

TEST_F(ServerLimits, ThousandsOfSlowClientsCostLittleAndHoldUpNobody) {
  write_large_pack();
  options_.connections_per_address = 0;
  RunningServer server(options_);
  const size_t before = resident();
  std::vector<std::unique_ptr<RawConnection>> clients;
  for (size_t i = possible(5000); i > 0; i--) {
    clients.push_back(std::make_unique<RawConnection>(server.port()));
    if (i % 3 == 0) clients.back()->send("GET / HT");
    if (i % 3 == 1) clients.back()->send(ask_for_large);
  }
  EXPECT_LT(slowest_answer(server.port()), promptly);
  EXPECT_LT(resident() - before, with_sanitizer * (size_t(30) << 20));
}

TEST_F(ServerLimits, BeyondTheLimitIdleOnesGo) {
  options_.max_connections = 100;
  RunningServer server(options_);
  RawConnection busy(server.port());
  write_large_pack();
  busy.send(ask_for_large);
  std::vector<std::unique_ptr<RawConnection>> idle;
  for (int i = 0; i < 300; i++) idle.push_back(std::make_unique<RawConnection>(server.port()));
  EXPECT_LT(slowest_answer(server.port()), promptly);
  EXPECT_TRUE(idle.front()->ended());
  EXPECT_EQ(idle.back()->get("/healthz").body, "ok\n");
  EXPECT_EQ(busy.receive().status, 200);
}

TEST_F(ServerLimits, ThenTheSlowestGo) {
  options_.max_connections = 10;
  write_large_pack();
  RunningServer server(options_);
  std::vector<std::unique_ptr<RawConnection>> dripping;
  for (int i = 0; i < 10; i++) {
    dripping.push_back(std::make_unique<RawConnection>(server.port()));
    dripping.back()->send("GET / HT");
  }
  RawConnection first(server.port());
  EXPECT_EQ(first.get("/healthz").body, "ok\n") << "within its patience of five seconds, though all are busy";
  EXPECT_LT(slowest_answer(server.port()), promptly) << "now it is known who is slow";
}

TEST_F(ServerLimits, OneAddressHasALimitOfItsOwn) {
  options_.connections_per_address = 5;
  RunningServer server(options_);
  RawConnection other(server.port(), "127.0.0.2");
  std::vector<std::unique_ptr<RawConnection>> same;
  for (int i = 0; i < 20; i++) same.push_back(std::make_unique<RawConnection>(server.port()));
  EXPECT_EQ(same.back()->get("/healthz").body, "ok\n");
  EXPECT_TRUE(same.front()->ended());
  EXPECT_EQ(other.get("/healthz").body, "ok\n") << "it was idle for longest, but is another's";
}

TEST_F(ServerLimits, OneAddressHasARateOfRequests) {
  options_.requests_per_second = 5;
  RunningServer server(options_);
  RawConnection hasty(server.port()), other(server.port(), "127.0.0.2");
  RawResponse refused;
  for (int i = 0; i < 20 && refused.status != 429; i++) refused = hasty.get("/healthz");
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(refused.fields.count("retry-after"), 1u);
  EXPECT_EQ(other.get("/healthz").status, 200);
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(hasty.get("/healthz").status, 200);
}

/// Takes all descriptors that the process may have, but for those in use.
class NoDescriptorsLeft {
 public:
  NoDescriptorsLeft() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit few{256, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
    for (int taken; (taken = ::open("/dev/null", O_RDONLY | O_CLOEXEC)) >= 0;) taken_.push_back(taken);
    EXPECT_EQ(errno, EMFILE);
  }
  NoDescriptorsLeft(const NoDescriptorsLeft&) = delete;
  NoDescriptorsLeft& operator=(const NoDescriptorsLeft&) = delete;
  ~NoDescriptorsLeft() {
    for (const int taken : taken_) ::close(taken);
    ::setrlimit(RLIMIT_NOFILE, &before_);
  }
  /// Gives one back.
  void spare_one() {
    ::close(taken_.back());
    taken_.pop_back();
  }

 private:
  rlimit before_{};
  std::vector<int> taken_;
};

TEST_F(ServerLimits, WithoutDescriptorsIsBusyAndLosesNothing) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("/healthz").status, 200);
  folder_.write("packs/new.glb", pack_of(6));
  const std::vector<std::string> there{"/packs/room.glb", "/packs/new.glb", "/packs.json", "/main.js"};
  {
    const NoDescriptorsLeft none;
    for (const std::string& target : there) {
      const RawResponse busy = connection.get(target);
      EXPECT_EQ(busy.status, 503) << target;
      EXPECT_EQ(busy.fields.count("retry-after"), 1u) << target;
    }
    EXPECT_EQ(connection.get("/packs/absent.glb").status, 404);
    EXPECT_EQ(connection.get("/healthz").status, 200);
  }
  for (const std::string& target : there) EXPECT_EQ(connection.get(target).status, 200) << target;
}

TEST_F(ServerLimits, WithoutDescriptorsIdleOnesGiveTheirs) {
  RunningServer server(options_);
  std::vector<std::unique_ptr<RawConnection>> idle;
  for (int i = 0; i < 4; i++) idle.push_back(std::make_unique<RawConnection>(server.port()));
  for (const auto& connection : idle) EXPECT_EQ(connection->get("/healthz").status, 200);
  NoDescriptorsLeft none;
  none.spare_one();  // for this side of the connection
  RawConnection fresh(server.port());
  EXPECT_EQ(fresh.get("/packs/room.glb").body.size(), pack_.size());
  EXPECT_TRUE(idle.front()->ended());
  EXPECT_EQ(idle.back()->get("/healthz").status, 200);
}

TEST_F(ServerLimits, StopsAfterTheAnswersUnderWay) {
  const std::string& large = write_large_pack();
  auto server = std::make_unique<RunningServer>(options_);
  RawConnection idle(server->port());
  RawConnection busy(server->port());
  EXPECT_EQ(idle.get("/healthz").status, 200);
  busy.send(ask_for_large);
  std::this_thread::sleep_for(50ms);  // the answer has begun, and cannot end before somebody reads it
  server->server().stop();
  EXPECT_TRUE(idle.ended());
  EXPECT_EQ(busy.receive().body.size(), large.size());
  server.reset();
}

TEST_F(ServerLimits, StopsAfterTheTimeOfGraceOrWhenToldAgain) {
  write_large_pack();
  for (const bool told_again : {false, true}) {
    options_.grace = told_again ? 60s : 300ms;
    auto server = std::make_unique<RunningServer>(options_);
    RawConnection busy(server->port());
    busy.send(ask_for_large);
    std::this_thread::sleep_for(50ms);
    const auto begin = Clock::now();
    server->server().stop();
    if (told_again) std::this_thread::sleep_for(100ms);
    server.reset();  // tells it again, and waits
    EXPECT_LT(Clock::now() - begin, 30s);
  }
}

}  // namespace
}  // namespace lightwell
