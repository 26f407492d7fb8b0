// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lightwell {

/// The manual page of the program with all its commands, for man(1), in the language of man(7).
std::string manual_page(const CLI::App& program);

/// The program's completion for bash: names of commands and options, and the words that an option takes. Everything
/// else is completed as a file's name.
std::string bash_completion(const CLI::App& program);

}  // namespace lightwell
