// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/resource.h"

#include <algorithm>
#include <array>

#include "lightwell/base/file.h"
#include "lightwell/base/hex.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int8_t, 256> base64_values = [] {
  std::array<int8_t, 256> values{};
  values.fill(-1);
  for (size_t i = 0; i < base64_digits.size(); i++)
    values[static_cast<uint8_t>(base64_digits[i])] = static_cast<int8_t>(i);
  return values;
}();

Result<std::vector<uint8_t>> decode_base64(std::string_view text) {
  for (int i = 0; i < 2 && text.ends_with('='); i++) text.remove_suffix(1);
  if (text.size() % 4 == 1) return fail("", "its data URI ends within a byte");
  std::vector<uint8_t> bytes;
  bytes.reserve(text.size() * 3 / 4);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int8_t value = base64_values[static_cast<uint8_t>(c)];
    if (value < 0) return fail("", "its data URI holds a character that is not base64");
    bits = bits << 6 | static_cast<uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<uint8_t>(bits >> count));
  }
  return bytes;
}

Result<std::vector<uint8_t>> read_data_uri(std::string_view uri) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return fail("", "its data URI has no data");
  if (uri.substr(0, comma).ends_with(";base64")) return decode_base64(uri.substr(comma + 1));
  const std::string plain = decode_percent(uri.substr(comma + 1));
  return std::vector<uint8_t>(plain.begin(), plain.end());
}

bool has_scheme(std::string_view uri) {
  const size_t colon = uri.find(':');
  return colon != std::string_view::npos && colon < uri.find_first_of("/?#");
}

Result<fs::path> path_below(const std::string& uri, const fs::path& folder) {
  const std::string name = decode_percent(uri);
  const fs::path relative(name);
  if (has_scheme(uri)) return fail("", "its URI has a scheme, only files beside the document are read");
  if (relative.empty() || relative.is_absolute() || name.find('\0') != std::string::npos ||
      std::find(relative.begin(), relative.end(), fs::path("..")) != relative.end())
    return fail("", "its URI does not lead to a file below the document's folder");
  std::error_code code;
  const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, code);
  const fs::path path = code ? fs::path() : fs::canonical(root / relative, code);
  if (code || !fs::is_regular_file(path, code))
    return fail(ErrorKind::io, "", "the file " + name.substr(0, 200) + " cannot be found");
  if (std::mismatch(root.begin(), root.end(), path.begin(), path.end()).first != root.end())
    return fail("", "its URI leads out of the document's folder by a link");
  return path;
}

}  // namespace

std::string decode_percent(std::string_view text) {
  std::string plain;
  for (size_t i = 0; i < text.size(); i++) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
    plain += low >= 0 ? static_cast<char>(high * 16 + low) : text[i];
    if (low >= 0) i += 2;
  }
  return plain;
}

Result<std::vector<uint8_t>> read_uri(const std::string& uri, const fs::path& folder) {
  if (uri.starts_with("data:")) return read_data_uri(uri);
  LW_TRY(path, path_below(uri, folder));
  return read_file(path);
}

}  // namespace lightwell
