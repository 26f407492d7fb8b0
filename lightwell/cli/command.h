// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "lightwell/cli/console.h"

namespace lightwell {

/// A function that adds a command to the program: its name, help and options. When the command is used, `chosen` is set
/// to the function that runs it, which returns the exit status: 0, 1 for bad input, 128 plus the signal's number when
/// cancelled. Bad usage is refused before that, with status 2.
using AddCommand = CLI::App* (*)(CLI::App& program, Console& console, std::function<int()>& chosen);

CLI::App* add_scenes(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_bake(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_info(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_verify(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_serve(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_fetch(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_render(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_probe(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_export(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_diff(CLI::App&, Console&, std::function<int()>&);
CLI::App* add_help(CLI::App&, Console&, std::function<int()>&);

}  // namespace lightwell
