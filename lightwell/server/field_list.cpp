// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/field_list.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <vector>

namespace lightwell {
namespace {

std::string_view trim(std::string_view text) {
  constexpr std::string_view space = " \t";
  const size_t first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(space) + 1 - first);
}

/// The elements of a list, cut at a character outside of quotes.
std::vector<std::string_view> elements(std::string_view list, char mark) {
  std::vector<std::string_view> found;
  bool quoted = false;
  size_t begin = 0;
  for (size_t at = 0; at <= list.size(); at++) {
    if (at < list.size() && list[at] == '"') quoted = !quoted;
    if (at < list.size() && (list[at] != mark || quoted)) continue;
    found.push_back(trim(list.substr(begin, at - begin)));
    begin = at + 1;
  }
  return found;
}

bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, {}, [](unsigned char c) { return std::tolower(c); }, [](unsigned char c) { return std::tolower(c); });
}

/// Whether a parameter is a weight of zero: "q=0", "q=0.000".
bool is_refusal(std::string_view parameter) {
  const std::vector<std::string_view> parts = elements(parameter, '=');
  return parts.size() == 2 && same_name(parts[0], "q") && !parts[1].empty() &&
         parts[1].find_first_not_of("0.") == std::string_view::npos;
}

}  // namespace

bool names_tag(std::string_view list, std::string_view etag) {
  constexpr std::string_view weak = "W/";
  return std::ranges::any_of(elements(list, ','), [&](std::string_view tag) {
    return tag == "*" || tag == etag || (tag.starts_with(weak) && tag.substr(weak.size()) == etag);
  });
}

bool names_strong_tag(std::string_view list, std::string_view etag) {
  return std::ranges::any_of(elements(list, ','), [&](std::string_view tag) { return tag == "*" || tag == etag; });
}

bool accepts_gzip(std::string_view list) {
  std::optional<bool> named, any;
  for (const std::string_view element : elements(list, ',')) {
    const std::vector<std::string_view> parts = elements(element, ';');
    const bool accepted = std::none_of(parts.begin() + 1, parts.end(), is_refusal);
    if (same_name(parts[0], "gzip") || same_name(parts[0], "x-gzip")) named = accepted;
    if (parts[0] == "*") any = accepted;
  }
  return named.value_or(any.value_or(false));
}

}  // namespace lightwell
