// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/byte_range.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace lightwell {
namespace {

std::optional<uint64_t> number(std::string_view text) {
  uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size()) return UINT64_MAX;
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

ByteRange parse_range(std::string_view header, uint64_t file_length) {
  const ByteRange whole{ByteRange::Kind::whole, 0, file_length};
  constexpr std::string_view unit = "bytes=";
  if (!header.starts_with(unit)) return whole;
  const std::string_view spec = header.substr(unit.size());
  const size_t dash = spec.find('-');
  if (dash == std::string_view::npos) return whole;
  const std::string_view before = spec.substr(0, dash), behind = spec.substr(dash + 1);

  uint64_t first = 0, last = UINT64_MAX;
  if (before.empty()) {
    const std::optional<uint64_t> suffix = number(behind);
    if (!suffix) return whole;
    first = file_length - std::min(*suffix, file_length);
  } else {
    const std::optional<uint64_t> from = number(before);
    const std::optional<uint64_t> to = behind.empty() ? UINT64_MAX : number(behind);
    if (!from || !to || *to < *from) return whole;
    first = *from;
    last = *to;
  }
  if (first >= file_length) return {ByteRange::Kind::unsatisfiable, 0, 0};
  return {ByteRange::Kind::part, first, std::min(last, file_length - 1) - first + 1};
}

}  // namespace lightwell
