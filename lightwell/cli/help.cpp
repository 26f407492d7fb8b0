// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/command.h"
#include "lightwell/cli/manual.h"

namespace lightwell {

CLI::App* add_help(CLI::App& program, Console&, std::function<int()>& chosen) {
  struct Options {
    bool manual = false, completion = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("help", "Tells what the commands do, also as a manual page");
  command->add_flag("--man", options->manual, "The manual page, for `man -l`");
  command->add_flag("--completion", options->completion, "The completion of commands and options for bash");
  command->footer("Examples:\n  lightwell help --man | man -l -\n  source <(lightwell help --completion)");
  command->callback([=, &program, &chosen] {
    if (options->manual && options->completion)
      throw CLI::ValidationError("--man and --completion", "one of them at a time");
    chosen = [=, &program] {
      const std::string text = options->manual       ? manual_page(program)
                               : options->completion ? bash_completion(program)
                                                     : program.get_formatter()->make_help(&program, program.get_name(),
                                                                                          CLI::AppFormatMode::Normal);
      std::fputs(text.c_str(), stdout);
      return 0;
    };
  });
  return command;
}

}  // namespace lightwell
