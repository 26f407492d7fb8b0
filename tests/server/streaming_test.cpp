// SPDX-License-Identifier: Apache-2.0
//
// The client over HTTP against servers that run: ours, and nginx.
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <functional>

#include "lightwell/transport/fetch.h"
#include "tests/client/received_scene.h"
#include "tests/client/sample_pack.h"
#include "tests/server/running_server.h"

namespace lightwell {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

std::string as_text(const std::vector<uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

/// A pack of many requests, and another one of the same layout.
struct Sample {
  std::vector<uint8_t> file, other;
  ReceivedScene scene, other_scene;
};

const Sample& sample() {
  static const Sample made = [] {
    const SampleScene scene = sample_scene(60000, 12);
    Sample packs{sample_pack(scene), sample_pack(scene, 1), {}, {}};
    packs.scene = decode_directly(packs.file);
    packs.other_scene = decode_directly(packs.other);
    return packs;
  }();
  return made;
}

/// A process of its own, killed without a word at the end.
class Process {
 public:
  explicit Process(const std::function<void()>& run) : id_(::fork()) {
    if (id_ != 0) return;
    run();
    ::_exit(1);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }

 private:
  pid_t id_;
};

uint16_t free_port() {
  ServerOptions options;
  options.port = 0;
  return Server::listen(options).value().port();
}

bool is_listening(uint16_t port) {
  const int probe = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool connected = ::connect(probe, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  ::close(probe);
  return connected;
}

/// Gives a server ten seconds to open its port.
void wait_for(uint16_t port) {
  for (int i = 0; i < 1000 && !is_listening(port); i++) std::this_thread::sleep_for(10ms);
}

class Streaming : public testing::Test {
 protected:
  Streaming() { folder_.write("packs/sample.glb", as_text(sample().file)); }

  std::unique_ptr<Process> start_server() const {
    ServerOptions options;
    options.port = port_;
    options.packs = {folder_.path() / "packs"};
    auto process = std::make_unique<Process>([&] {
      if (auto server = Server::listen(options)) server->run();
    });
    wait_for(port_);
    return process;
  }

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/packs/sample.glb"; }

  /// Streams the pack into scene_. `on_opening` is called when the opening has been handed over, and `often` ever
  /// again.
  Result<FetchOutcome> stream(
      const std::function<void()>& on_opening = [] {}, const std::function<void()>& often = [] {}) {
    scene_ = {};
    LW_TRY(transport, http_transport(url()));
    Client client({});
    const auto apply = [&](const Update& update) {
      EXPECT_EQ(scene_.apply(update), "");
      if (!std::holds_alternative<OpeningUpdate>(update)) return;
      EXPECT_LT(client.progress().bytes, sample().file.size() / 2) << "the stream has just begun";
      on_opening();
    };
    const auto never = [&] {
      often();
      return false;
    };
    return fetch(client, *transport, apply, {.cancelled = never});
  }

  /// Puts another file in place of the pack, as a baker does.
  void replace_pack(const std::vector<uint8_t>& file) const {
    std::filesystem::rename(folder_.write("new", as_text(file)), folder_.path() / "packs/sample.glb");
  }

  const uint16_t port_ = free_port();
  TemporaryFolder folder_;
  ReceivedScene scene_;
};

TEST_F(Streaming, IsExact) {
  const auto server = start_server();
  const auto outcome = stream();
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_EQ(outcome->bytes, sample().file.size());
  EXPECT_TRUE(scene_ == sample().scene);
}

TEST_F(Streaming, OverIPv6) {
  ServerOptions options;
  options.bind = "::1";
  options.port = 0;
  options.packs = {folder_.path() / "packs"};
  if (!Server::listen(options)) GTEST_SKIP() << "left out: this machine has no IPv6";
  RunningServer server(options);
  EXPECT_EQ(server.server().url(), "http://[::1]:" + std::to_string(server.port()) + "/");
  const auto transport = http_transport(server.server().url() + "packs/sample.glb");
  ASSERT_TRUE(transport) << transport.error().message();
  Client client({});
  const auto outcome = fetch(client, **transport, [](const Update&) {});
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_EQ(outcome->bytes, sample().file.size());
}

TEST_F(Streaming, SurvivesTheServersDeath) {
  auto server = start_server();
  Clock::time_point death;
  const auto kill = [&] {
    server.reset();
    death = Clock::now();
  };
  const auto restart = [&] {
    if (!server && Clock::now() > death + 300ms) server = start_server();
  };
  const auto outcome = stream(kill, restart);
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_GT(outcome->seconds, 0.3);
  EXPECT_TRUE(scene_ == sample().scene);
}

TEST_F(Streaming, NoticesAnotherFile) {
  const auto server = start_server();
  const auto outcome = stream([&] { replace_pack(sample().other); });
  ASSERT_FALSE(outcome);
  EXPECT_EQ(scene_.reason, FailureUpdate::Reason::replaced) << scene_.failure;
  EXPECT_TRUE(scene_.shows_only(sample().scene, on_the_way(sample().file)));
  ASSERT_TRUE(stream()) << "a new client reads the new file";
  EXPECT_TRUE(scene_ == sample().other_scene);
}

TEST_F(Streaming, NoticesThatTheFileHasGone) {
  const auto server = start_server();
  ASSERT_FALSE(stream([&] { std::filesystem::remove(folder_.path() / "packs/sample.glb"); }));
  EXPECT_EQ(scene_.reason, FailureUpdate::Reason::refused) << scene_.failure;
  EXPECT_NE(scene_.failure.find("404"), std::string::npos) << scene_.failure;
}

TEST_F(Streaming, FromNginx) {
  if (std::system("command -v nginx >/dev/null") != 0) GTEST_SKIP() << "left out: nginx is not installed";
  const std::string scratch = folder_.path();
  std::string paths;
  for (const char* name : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
    paths += std::string(name) + "_temp_path " + scratch + "/" + name + ";\n";
  const std::string configuration = folder_.write(
      "nginx.conf", "daemon off; master_process off; pid " + scratch + "/pid;\nevents {}\nhttp {\naccess_log off;\n" +
                        paths + "server { listen 127.0.0.1:" + std::to_string(port_) + "; root " + scratch +
                        "; }\n}\n");
  const std::string log = scratch + "/error.log";
  const Process nginx([&] { ::execlp("nginx", "nginx", "-c", configuration.c_str(), "-e", log.c_str(), nullptr); });
  wait_for(port_);
  const auto outcome = stream();
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(scene_ == sample().scene);
  replace_pack(sample().other);
  ASSERT_TRUE(stream());
  EXPECT_TRUE(scene_ == sample().other_scene);
}

}  // namespace
}  // namespace lightwell
