// SPDX-License-Identifier: Apache-2.0
//
// What `lightwell serve` says when it starts; what it answers is tests/server's.
#include <regex>

#include "tests/cli/commands.h"
#include "tests/server/running_server.h"

namespace lightwell {
namespace {

class Serve : public Commands {
 protected:
  /// Serves until the address is told.
  Outcome started(const std::string& arguments) const {
    return run_in_shell(serve(arguments) + redirected() + " & until grep -qs http " + path("stdout") +
                        "; do kill -0 $! 2>/dev/null || break; sleep 0.02; done; kill $! 2>/dev/null; wait $!");
  }
  /// The same on a terminal, where Ctrl-C is pressed after ten seconds at the latest.
  Outcome started_on_a_terminal(const std::string& arguments) const {
    return run_in_shell("(for i in $(seq 500); do grep -qs http " + path("stdout") +
                        " && break; sleep 0.02; done; printf '\\003') | script -qefc '" + serve(arguments) +
                        "' /dev/null" + redirected());
  }

 private:
  std::string serve(const std::string& arguments) const {
    return LIGHTWELL_PROGRAM " serve --port 0 --page " + folder().string() + " " + arguments;
  }
};

TEST_F(Serve, TellsProgramsAndPeopleWhereItIs) {
  const std::string pack = small_pack();
  const Outcome piped = started(pack);
  EXPECT_EQ(piped.status, 0);
  EXPECT_TRUE(
      std::regex_match(json::parse(piped.out)["url"].get<std::string>(), std::regex(R"(http://127\.0\.0\.1:\d+/)")))
      << piped.out;
  const std::string sentence = started_on_a_terminal(pack).out;
  EXPECT_TRUE(std::regex_search(
      sentence, std::regex(R"(^Lightwell is at http://127\.0\.0\.1:\d+/ until you press Ctrl-C\.\r\n)")))
      << sentence;
  EXPECT_EQ(sentence.find('{'), std::string::npos) << sentence;
  EXPECT_EQ(started_on_a_terminal(pack + " --json").out.rfind("{\"url\":", 0), 0u);
}

TEST_F(Serve, WarnsOfAFolderWithoutAPack) {
  fs::create_directories(path("empty"));
  write("empty/other.glb", "glTF but not really");
  const std::string warning = "lightwell: warning: " + path("empty") + ": there is no pack in it yet\n";
  EXPECT_EQ(started(path("empty")).err, warning);
  EXPECT_EQ(started(path("empty") + " --quiet").err, "");
  fs::create_directories(path("full"));
  fs::copy(small_pack(), path("full/box.lw.glb"));
  EXPECT_EQ(started(path("full") + " " + path("empty")).err, warning);
}

TEST_F(Serve, SaysWhatToDoAboutAPortInUse) {
  ServerOptions options;
  options.packs = {folder()};
  const RunningServer other(options);
  const std::string port = std::to_string(other.port());
  const Outcome refused = run("serve --port " + port + " " + folder().string());
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "lightwell: 127.0.0.1:" + port + ": Address already in use; --port 0 takes a free one\n");
}

TEST_F(Serve, PutsAnIPv6AddressIntoBrackets) {
  const Outcome outcome = started(small_pack() + " --bind ::1");
  if (outcome.status != 0) GTEST_SKIP() << "left out: this machine has no IPv6: " << outcome.err;
  EXPECT_TRUE(
      std::regex_match(json::parse(outcome.out)["url"].get<std::string>(), std::regex(R"(http://\[::1\]:\d+/)")))
      << outcome.out;
}

TEST_F(Serve, ListensOnLocalhostByName) {
  const Outcome outcome = started(small_pack() + " --bind localhost");
  EXPECT_EQ(json::parse(outcome.out)["url"].get<std::string>().rfind("http://localhost:", 0), 0u) << outcome.err;
  EXPECT_EQ(outcome.status, 0);
  const Outcome refused = started(folder().string() + " --bind example");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("example: is neither an IP address nor localhost"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace lightwell
