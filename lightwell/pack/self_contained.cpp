// SPDX-License-Identifier: Apache-2.0
#include "lightwell/pack/self_contained.h"

#include "lightwell/base/hex.h"

namespace lightwell {
namespace {

/// Reads the string after the quote text[at - 1] and moves `at` past its closing quote. Escaped non-ASCII characters
/// become '?', since no key that matters has one.
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

/// Whether a glTF loader fetches this member: buffers[i].uri and images[i].uri.
bool is_fetched(std::string_view section, std::string_view key, int depth) {
  return depth == 3 && key == "uri" && (section == "buffers" || section == "images");
}

}  // namespace

Result<void> check_self_contained(std::string_view json) {
  int depth = 0;        // nesting of objects and arrays; 1 in the root object
  std::string section;  // the root object's current key
  for (size_t at = 0; at < json.size();) {
    const char c = json[at++];
    if (c == '{' || c == '[') depth++;
    if (c == '}' || c == ']') depth--;
    if (c != '"') continue;
    const std::string text = read_string(json, at);
    const size_t colon = skip_space(json, at);
    if (colon >= json.size() || json[colon] != ':') continue;
    if (depth == 1) section = text;
    const size_t value = skip_space(json, colon + 1);
    if (!is_fetched(section, text, depth) || value >= json.size() || json[value] != '"') continue;
    at = value + 1;
    const std::string uri = read_string(json, at);
    if (!uri.starts_with("data:")) return fail("opening", "refers to another file: " + uri.substr(0, 80));
  }
  return {};
}

}  // namespace lightwell
