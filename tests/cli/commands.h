// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/temporary_folder.h"

namespace lightwell {

namespace fs = std::filesystem;
using nlohmann::json;

struct Outcome {
  int status = 0;
  std::string out, err;

  size_t lines() const { return static_cast<size_t>(std::count(err.begin(), err.end(), '\n')); }
};

/// Runs the program in a folder of the test's own.
class Commands : public testing::Test {
 protected:
  Outcome run(const std::string& arguments) const {
    return run_in_shell("timeout 300 " LIGHTWELL_PROGRAM " " + arguments + redirected());
  }
  /// Sends a signal ("INT", "TERM") once the program has said `word` on stderr.
  Outcome interrupt(const std::string& arguments, const std::string& word, const std::string& signal) const {
    return run_in_shell(LIGHTWELL_PROGRAM " " + arguments + redirected() + " & until grep -qs '" + word + "' " +
                        path("stderr") + "; do kill -0 $! 2>/dev/null || break; sleep 0.02; done; kill -" + signal +
                        " $!; wait $!");
  }
  const fs::path& folder() const { return folder_.path(); }
  std::string path(const std::string& name) const { return (folder() / name).string(); }
  std::string redirected() const { return " >" + path("stdout") + " 2>" + path("stderr"); }
  Outcome run_in_shell(const std::string& command) const {
    fs::remove(path("stdout"));  // who waits for a word must not find that of the run before
    fs::remove(path("stderr"));
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(path("stdout")), read(path("stderr"))};
  }
  static std::string read(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  /// Bakes box-small with few photons.
  std::string small_pack(const std::string& more = "") const {
    const std::string pack = path("box.lw.glb");
    const Outcome baked = run("bake box-small -o " + pack + " --photons 20k --grid 6 --quiet " + more);
    EXPECT_EQ(baked.status, 0) << baked.err;
    return pack;
  }
  /// What `probe` finds at points, with their columns' heads in the first line: red, green and blue of each.
  std::vector<double> probed(const std::string& arguments, const std::string& points) const {
    write("points.csv", points);
    const Outcome found = run("probe " + arguments + " --json --quiet --points " + path("points.csv"));
    EXPECT_EQ(found.status, 0) << found.err;
    std::vector<double> values;
    const json parsed = json::parse(found.out);
    for (const json& point : parsed["points"])
      for (const json& value : point["rgb"]) values.push_back(value);
    return values;
  }

 private:
  const TemporaryFolder folder_;
};

}  // namespace lightwell
