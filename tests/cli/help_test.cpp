// SPDX-License-Identifier: Apache-2.0
//
// The manual page and the completion for bash, which are made of the same commands as --help.
#include <regex>
#include <set>

#include "tests/cli/commands.h"

namespace lightwell {
namespace {

std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern, std::regex::ECMAScript | std::regex::multiline);
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) found.push_back((*at)[1]);
  return found;
}

/// The commands that the program's help lists.
std::vector<std::string> commands(const std::string& help) { return all_matches(help, "^  ([a-z]+)  "); }
/// The long options that a command's help lists.
std::vector<std::string> options(const std::string& help) { return all_matches(help, "^  (?:-[a-z],)?(--[a-z-]+)"); }

class Help : public Commands {
 protected:
  /// What bash offers for the last of the words of a command line.
  std::set<std::string> completed(const std::vector<std::string>& words) const {
    const Outcome script = run("help --completion");
    write("completion", script.out + "COMP_WORDS=(\"$@\")\nCOMP_CWORD=$(($# - 1))\n_lightwell lightwell \"${!#}\" " +
                            "\"${COMP_WORDS[COMP_CWORD - 1]}\"\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
    std::string line = "bash " + path("completion");
    for (const std::string& word : words) line += " '" + word + "'";
    std::istringstream offered(run_in_shell(line + redirected()).out);
    return {std::istream_iterator<std::string>(offered), {}};
  }
};

TEST_F(Help, ManualPageHasEveryCommandAndOption) {
  std::string page = run("help --man").out;
  page = std::regex_replace(page, std::regex(R"(\\f[BIR])"), "");
  page = std::regex_replace(page, std::regex(R"(\\-)"), "-");
  const std::vector<std::string> all = commands(run("--help").out);
  EXPECT_GE(all.size(), 11u);
  for (const std::string& command : all) {
    const size_t section = page.find("\n.SS lightwell " + command + " ");
    ASSERT_NE(section, std::string::npos) << command;
    const std::string text = page.substr(section, page.find("\n.S", section + 1) - section);
    const std::vector<std::string> listed = options(run(command + " --help").out);
    EXPECT_GE(listed.size(), 3u) << command;
    for (const std::string& option : listed) EXPECT_NE(text.find(option), std::string::npos) << command << option;
  }
}

TEST_F(Help, BashCompletesCommandsOptionsAndChoices) {
  const std::vector<std::string> all = commands(run("--help").out);
  const std::set<std::string> offered = completed({"lightwell", ""});
  for (const std::string& command : all) EXPECT_TRUE(offered.contains(command)) << command;
  EXPECT_TRUE(offered.contains("--version"));
  EXPECT_EQ(completed({"lightwell", "pro"}), std::set<std::string>{"probe"});
  for (const std::string& command : all) {
    const std::set<std::string> names = completed({"lightwell", command, "-"});
    for (const std::string& option : options(run(command + " --help").out))
      EXPECT_TRUE(names.contains(option)) << command << " " << option;
  }
  EXPECT_EQ(completed({"lightwell", "bake", "--up", ""}), (std::set<std::string>{"x", "-x", "y", "-y", "z", "-z"}));
  EXPECT_EQ(completed({"lightwell", "bake", "--seed", "1", "--grid", "a"}), std::set<std::string>{"auto"});
  // A file's name, which bash itself completes where nothing is offered.
  EXPECT_EQ(completed({"lightwell", "bake", "-o", ""}), std::set<std::string>{});
  EXPECT_EQ(completed({"lightwell", "bake", "room"}), std::set<std::string>{});
}

TEST_F(Help, AloneIsTheHelpOfTheProgram) { EXPECT_EQ(run("help").out, run("--help").out); }

}  // namespace
}  // namespace lightwell
