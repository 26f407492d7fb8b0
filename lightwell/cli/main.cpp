// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <new>
#include <stdexcept>

#include "lightwell/cli/command.h"
#include "lightwell/cli/memory_limit.h"
#include "lightwell/cli/option_kinds.h"

namespace {

// Describes what is wrong with a command line.
std::string complaint(const CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  const std::vector<std::string> rest = program.remaining(true);
  std::string reason = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return reason.substr(0, reason.find(':')) + ": takes one value";
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || rest.empty()) return reason;
  std::string text;
  for (const std::string& argument : rest) text += (text.empty() ? "" : " ") + argument;
  if (rest.front().starts_with("-")) return text + ": no such option";
  return chosen.empty() ? rest.front() + ": no such command" : text + ": more than was expected";
}

// Refuses a command line in one line, which also points to the help.
int refuse(const CLI::App& program, const std::string& reason) {
  const auto chosen = program.get_subcommands();
  const std::string command = chosen.empty() ? "" : chosen.front()->get_name();
  std::fprintf(stderr, "lightwell: %s%s; see `lightwell %s--help`\n", command.empty() ? "" : (command + ": ").c_str(),
               reason.c_str(), command.empty() ? "" : (command + " ").c_str());
  return 2;
}

// Runs the command. Where memory ends, what is being written goes away and one line is said.
int run(const std::function<int()>& command, const lightwell::Console& console) {
  try {
    return command();
  } catch (const std::bad_alloc&) {
    return console.fail({"", "", lightwell::memory_has_ended});
  } catch (const std::length_error&) {
    return console.fail({"", "", lightwell::memory_has_ended});
  } catch (const std::exception& exception) {
    return console.fail({"", "", exception.what()});
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lightwell;

  prepare_for_the_end_of_memory();
  CLI::App program("Bakes the indirect light of 3D scenes and streams light and geometry to browsers.", "lightwell");
  program.set_version_flag("--version", LIGHTWELL_VERSION);
  program.require_subcommand(0, 1);
  program.get_formatter()->column_width(36);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.get_formatter()->label("Positionals", "Arguments");
  program.get_formatter()->label("REQUIRED", "(needed)");
  program.footer("`lightwell COMMAND --help` tells more of one, with examples.");

  Console console;
  std::function<int()> chosen;
  for (const AddCommand add : {add_scenes, add_bake, add_info, add_verify, add_serve, add_fetch, add_render, add_probe,
                               add_export, add_diff}) {
    CLI::App* command = add(program, console, chosen);
    command->group("Commands");
    command->add_flag("--json", console.json, "Print one JSON object");
    command->add_flag("--quiet", console.quiet, "No progress and no warnings");
  }
  add_help(program, console, chosen)->group("Commands");

  try {
    program.parse(with_values_joined(argc, argv));
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? program.exit(error) : refuse(program, complaint(program, error));
  }
  if (!chosen) return refuse(program, "a command is missing");
  const int status = run(chosen, console);
  if (status == 0 && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0))
    return console.fail({"stdout", "", "cannot be written"});
  return status;
}
