// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>

#include "lightwell/cli/manual.h"

namespace lightwell {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::vector<std::string> option_names(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

// The words that an option takes, those of "auto|N" that are not capitals, which stand for something.
std::vector<std::string> choices(const CLI::Option& option) {
  std::vector<std::string> words;
  const std::string kinds = option.get_type_name();
  for (size_t at = 0; at <= kinds.size();) {
    const size_t end = std::min(kinds.find('|', at), kinds.size());
    const std::string word = kinds.substr(at, end - at);
    const auto is_capital = [](unsigned char c) { return std::isupper(c) != 0; };
    if (!word.empty() && std::none_of(word.begin(), word.end(), is_capital)) words.push_back(word);
    at = end + 1;
  }
  return words;
}

// The cases of bash that give the words behind an option of a command, and the command's options.
std::string cases_of(const CLI::App& command) {
  std::string cases;
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option_names(*option)) {
      names.push_back(name);
      const std::vector<std::string> words = choices(*option);
      if (option->get_items_expected_max() > 0)
        cases += "    '" + command.get_name() + " " + name + " '*) words='" + joined(words) + "' ;;\n";
    }
  }
  return cases + "    '" + command.get_name() + " '*' -'*) words='" + joined(names) + "' ;;\n";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back(command->get_name());
    cases += cases_of(*command);
  }
  for (const CLI::Option* option : program.get_options())
    for (const std::string& name : option_names(*option)) names.push_back(name);
  return "# Completion of lightwell for bash, as `lightwell help --completion` prints it.\n"
         "_lightwell() {\n"
         "  local words=\n"
         "  case \"${COMP_WORDS[1]} $3 $2\" in\n" +
         cases +
         "  esac\n"
         "  [ \"$COMP_CWORD\" != 1 ] || words='" +
         joined(names) +
         "'\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$2\"))\n"
         "}\n"
         "complete -o default -F _lightwell lightwell\n";
}

}  // namespace lightwell
