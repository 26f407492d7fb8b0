// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/option_kinds.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "lightwell/base/file.h"

namespace lightwell {
namespace {

// "0.5", "1048576", "1e-09"
std::string short_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", number);
  return text;
}

std::string range_text(NumberRange range) { return short_text(range.least) + " to " + short_text(range.most); }

bool in_range(double number, NumberRange range) { return number >= range.least && number <= range.most; }

// Whether a path is a device or a pipe, which may have any name.
bool is_device(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown) &&
         !std::filesystem::is_directory(path, unknown);
}

}  // namespace

CLI::Option* add_text(CLI::App& command, const std::string& name, const std::string& kind,
                      const std::function<Result<void>(const std::string&)>& take, const std::string& help) {
  const auto take_or_refuse = [take, long_name = name.substr(name.find(',') + 1)](const std::string& text) {
    if (auto taken = take(text); !taken) throw CLI::ValidationError(long_name, taken.error().message());
  };
  return command.add_option_function<std::string>(name, take_or_refuse, help)->type_name(kind);
}

Result<double> parse_number(const std::string& text, NumberRange range) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !in_range(number, range))
    return fail(text, "is not a number from " + range_text(range));
  return number;
}

CLI::Option* add_optional_number(CLI::App& command, const std::string& name, std::optional<float>& value,
                                 NumberRange range, float usual, const std::string& help) {
  return add_number(command, name, value, range, help)->expected(0, 0)->default_str(short_text(usual));
}

std::vector<std::string> with_values_joined(int count, char** arguments) {
  std::vector<std::string> joined;
  for (int i = 1; i < count; i++) {
    constexpr double any = std::numeric_limits<double>::max();
    if (!joined.empty() && joined.back() == "--sky" && parse_number(arguments[i], {-any, any}))
      joined.back() += std::string("=") + arguments[i];
    else
      joined.emplace_back(arguments[i]);
  }
  std::ranges::reverse(joined);
  return joined;
}

Result<int64_t> parse_whole(const std::string& text, NumberRange range) {
  int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool read = error == std::errc() && end == text.data() + text.size();
  if (!read || !in_range(static_cast<double>(number), range))
    return fail(text, "is not a whole number from " + range_text(range));
  return number;
}

std::optional<uint64_t> parse_count(const std::string& text) {
  constexpr double most = 1e15;
  char* end = nullptr;
  double number = std::strtod(text.c_str(), &end);
  switch (*end) {
    case 'k':
    case 'K': number *= 1e3, end++; break;
    case 'm':
    case 'M': number *= 1e6, end++; break;
    case 'g':
    case 'G': number *= 1e9, end++; break;
    default: break;
  }
  if (end == text.c_str() || *end != 0 || !in_range(number, {0, most}) || number != std::floor(number))
    return std::nullopt;
  return static_cast<uint64_t>(number);
}

CLI::Option* add_count(CLI::App& command, const std::string& name, uint64_t& value, const std::string& help,
                       const std::string& expected) {
  const auto take = [&value, expected](const std::string& text) -> Result<void> {
    const std::optional<uint64_t> count = parse_count(text);
    if (!count) return fail(text, "is not " + expected);
    if (*count == 0) return fail(text, "is not at least 1");
    value = *count;
    return {};
  };
  return add_text(command, name, "COUNT", take, help);
}

std::string one_of(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); i++) text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

CLI::Option* add_output(CLI::App& command, std::string& path, const std::vector<std::string>& endings,
                        const std::string& help, const std::string& name) {
  const auto take = [&path, endings](const std::string& text) -> Result<void> {
    const bool known = std::ranges::any_of(endings, [&](const std::string& ending) { return text.ends_with(ending); });
    if (!known && text != "-" && !is_device(text)) return fail(text, "the name does not end in " + one_of(endings));
    path = text;
    return {};
  };
  return add_text(command, name, "FILE", take, help);
}

Result<void> check_output(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code missing;
    if (!is_device(output) && std::filesystem::equivalent(output, input, missing))
      return fail({output, "", "would replace the file that is read; choose another name"});
  }
  return check_writable(output);
}

}  // namespace lightwell
