// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "lightwell/base/result.h"

namespace lightwell {

// The kinds of options that commands share. A value that does not fit is bad usage; the error names the option, the
// value, and what was expected.

/// Adds an option whose text `take` reads; `kind` stands for the value in the help ("NUMBER").
CLI::Option* add_text(CLI::App& command, const std::string& name, const std::string& kind,
                      const std::function<Result<void>(const std::string&)>& take, const std::string& help);

/// A range of numbers, both ends included.
struct NumberRange {
  double least = 0, most = 1;
};

/// The seeds that options take: whole numbers that JSON keeps exactly.
constexpr NumberRange seed_range = {0, 1e15};

/// Reads a number; nan, infinity and numbers outside the range are refused.
Result<double> parse_number(const std::string& text, NumberRange range);
/// Reads a whole number in the range.
Result<int64_t> parse_whole(const std::string& text, NumberRange range);
/// Reads a whole number that may end in k, M or G, small or large ("8M" is 8 000 000), or have an exponent ("1e6");
/// nothing if the text is not a count.
std::optional<uint64_t> parse_count(const std::string& text);

/// Adds an option whose value is a number of the range. T is a number, or an std::optional of one.
template <typename T>
CLI::Option* add_number(CLI::App& command, const std::string& name, T& value, NumberRange range,
                        const std::string& help) {
  const auto take = [&value, range](const std::string& text) -> Result<void> {
    LW_TRY(number, parse_number(text, range));
    value = static_cast<T>(number);
    return {};
  };
  return add_text(command, name, "NUMBER", take, help);
}

/// Adds an option that may be followed by a number of the range; without, it is `usual`. The option must be known to
/// with_values_joined().
CLI::Option* add_optional_number(CLI::App& command, const std::string& name, std::optional<float>& value,
                                 NumberRange range, float usual, const std::string& help);

/// The arguments of a command line, in the order in which CLI11 takes them, the last one first. A number behind an
/// option of add_optional_number() becomes part of it, "--sky=4", since CLI11 would take any word for its value, the
/// scene too.
std::vector<std::string> with_values_joined(int count, char** arguments);

/// Adds an option whose value is a whole number of the range.
template <typename T>
CLI::Option* add_whole(CLI::App& command, const std::string& name, T& value, NumberRange range,
                       const std::string& help) {
  const auto take = [&value, range](const std::string& text) -> Result<void> {
    LW_TRY(number, parse_whole(text, range));
    value = static_cast<T>(number);
    return {};
  };
  return add_text(command, name, "N", take, help)->default_str(std::to_string(value));
}

/// Adds an option whose value is a count of at least 1, as parse_count reads it. `expected` describes it, with
/// examples, for the error message.
CLI::Option* add_count(CLI::App& command, const std::string& name, uint64_t& value, const std::string& help,
                       const std::string& expected);

/// "a, b or c"
std::string one_of(const std::vector<std::string>& names);

/// Adds an option whose value is one of several names, each of which stands for a value of the program.
template <typename T>
CLI::Option* add_choice(CLI::App& command, const std::string& name, T& value,
                        const std::vector<std::pair<std::string, T>>& choices, const std::string& help) {
  std::vector<std::string> names;
  std::string kind, standard;
  for (const auto& [choice, meaning] : choices) {
    names.push_back(choice);
    kind += (kind.empty() ? "" : "|") + choice;
    if (meaning == value) standard = choice;
  }
  const auto take = [&value, choices, names](const std::string& text) -> Result<void> {
    for (const auto& [choice, meaning] : choices) {
      if (choice != text) continue;
      value = meaning;
      return {};
    }
    return fail(text, "is not " + one_of(names));
  };
  return add_text(command, name, kind, take, help)->default_str(standard);
}

/// Adds an option that chooses a row of a table (estimators, integrators) by its name; the help lists each row with its
/// own help. `offered` tells which rows can be chosen.
template <typename Row>
CLI::Option* add_row_choice(
    CLI::App& command, const std::string& name, const Row*& value, std::span<const Row> table,
    bool (*offered)(const Row&) = [](const Row&) { return true; }) {
  std::vector<std::pair<std::string, const Row*>> choices;
  std::string help;
  for (const Row& row : table) {
    if (!offered(row)) continue;
    choices.emplace_back(row.name, &row);
    help += (help.empty() ? "" : "; ") + std::string(row.name) + ": " + row.help;
  }
  return add_choice<const Row*>(command, name, value, choices, help);
}

/// Adds -o, or the option of another name, the file that the command writes. Its name must end in one of `endings`, the
/// first of which is also the format for stdout ("-") and devices. check_output, called when the command begins, tests
/// whether it can be written.
CLI::Option* add_output(CLI::App& command, std::string& path, const std::vector<std::string>& endings,
                        const std::string& help, const std::string& name = "-o,--output");

/// Fails when `output` cannot be written, or is one of the files that the command reads, under this name or another.
/// Called before any work.
Result<void> check_output(const std::string& output, const std::vector<std::string>& inputs);

}  // namespace lightwell
