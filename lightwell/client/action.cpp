// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/action.h"

namespace lightwell {
namespace {

/// Removes a number from the front of `text`; nullopt when there is none or it is too long.
std::optional<uint64_t> take_number(std::string_view& text) {
  uint64_t value = 0;
  size_t digits = 0;
  while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9') {
    value = value * 10 + static_cast<uint64_t>(text[digits] - '0');
    digits++;
  }
  if (digits == 0 || digits > 18) return std::nullopt;
  text.remove_prefix(digits);
  return value;
}

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

}  // namespace

std::optional<ContentRange> ContentRange::parse(std::string_view text) {
  ContentRange range;
  if (!take(text, "bytes ")) return std::nullopt;
  if (!take(text, "*")) {
    range.first = take_number(text);
    if (!range.first || !take(text, "-")) return std::nullopt;
    range.last = take_number(text);
    if (!range.last || *range.last < *range.first) return std::nullopt;
  }
  if (!take(text, "/")) return std::nullopt;
  if (!take(text, "*")) {
    range.total = take_number(text);
    if (!range.total) return std::nullopt;
  }
  if (!text.empty()) return std::nullopt;
  return range;
}

}  // namespace lightwell
