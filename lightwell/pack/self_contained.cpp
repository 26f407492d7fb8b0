// SPDX-License-Identifier: Apache-2.0
#include "lightwell/pack/self_contained.h"

namespace lightwell {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Reads the string that begins behind text[at - 1] == '"' and moves `at` behind its end. Escaped characters that are
/// not ASCII become '?': no key that matters has one.
std::string read_string(std::string_view text, size_t& at) {
  std::string read;
  while (at < text.size() && text[at] != '"') {
    if (text[at] != '\\') {
      read += text[at++];
      continue;
    }
    const char escape = at + 1 < text.size() ? text[at + 1] : '?';
    at += 2;
    if (escape != 'u') {
      read += escape;
      continue;
    }
    int code = 0;
    for (size_t digit = 0; digit < 4 && at < text.size(); digit++) code = code * 16 + hex_digit(text[at++]);
    read += code > 0 && code < 128 ? static_cast<char>(code) : '?';
  }
  at++;
  return read;
}

size_t skip_space(std::string_view text, size_t at) {
  const size_t found = text.find_first_not_of(" \t\r\n", at);
  return found == std::string_view::npos ? text.size() : found;
}

}  // namespace

Result<void> check_self_contained(std::string_view json) {
  size_t at = 0;
  while ((at = json.find('"', at)) != std::string_view::npos) {
    at++;
    const std::string key = read_string(json, at);
    const size_t colon = skip_space(json, at);
    if (key != "uri" || colon >= json.size() || json[colon] != ':') continue;
    const size_t value = skip_space(json, colon + 1);
    if (value >= json.size() || json[value] != '"') continue;
    at = value + 1;
    const std::string uri = read_string(json, at);
    if (!uri.starts_with("data:")) return fail("opening", "refers to another file: " + uri.substr(0, 80));
  }
  return {};
}

}  // namespace lightwell
