// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/command.h"

int main(int argc, char** argv) {
  using namespace lightwell;

  CLI::App program("Bakes the indirect light of 3D scenes and streams light and geometry to browsers.", "lightwell");
  program.set_version_flag("--version", LIGHTWELL_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(36);

  Console console;
  std::function<int()> chosen;
  for (const AddCommand add : {add_scenes, add_bake, add_info, add_verify, add_serve, add_fetch, add_render, add_probe,
                               add_export, add_diff}) {
    CLI::App* command = add(program, console, chosen);
    command->add_flag("--json", console.json, "Print one JSON object");
    command->add_flag("--quiet", console.quiet, "No progress and no warnings");
  }

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = program.exit(error);
    return status == 0 ? 0 : 2;
  }
  return chosen();
}
