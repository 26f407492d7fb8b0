// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/catalog.h"

#include <algorithm>
#include <map>

#include "lightwell/base/hex.h"
#include "lightwell/pack/reader.h"

namespace lightwell {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view pack_prefix = "/packs/";

/// Undoes percent encoding (RFC 3986, 2.1). Nothing when it is broken or hides a zero byte.
std::optional<std::string> decode_percent(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); i++) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
    if (high < 0 || low < 0 || (high == 0 && low == 0)) return std::nullopt;
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

std::string encode_percent(std::string_view text) {
  std::string encoded;
  for (const char c : text) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
                       c == '.' || c == '_' || c == '~';
    if (plain) {
      encoded += c;
    } else {
      encoded += '%';
      encoded += "0123456789ABCDEF"[static_cast<uint8_t>(c) >> 4];
      encoded += "0123456789ABCDEF"[static_cast<uint8_t>(c) & 15];
    }
  }
  return encoded;
}

std::string json_string(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    if (static_cast<uint8_t>(c) < 0x20)
      json += std::string("\\u00") + "0123456789abcdef"[c >> 4] + "0123456789abcdef"[c & 15];
    else
      json += c;
  }
  return json + '"';
}

/// A name that stays in its folder and is not hidden.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string_view::npos &&
         name.find('\0') == std::string_view::npos;
}

bool is_pack_name(std::string_view name) { return is_plain_name(name) && name.ends_with(".glb"); }

bool is_file(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

std::vector<fs::path> packs_in(const fs::path& folder) {
  std::vector<fs::path> packs;
  std::error_code gone;
  for (fs::directory_iterator entry(folder, gone), end; !gone && entry != end; entry.increment(gone)) {
    const fs::path& file = entry->path();
    if (is_pack_name(file.filename().string()) && is_file(file) && is_pack_file(file.string())) packs.push_back(file);
  }
  return packs;
}

/// A file below a folder, named by a path of plain names. What links lead to must be below the folder, too.
std::optional<fs::path> file_below(const fs::path& folder, std::string_view relative) {
  fs::path path = folder;
  for (size_t at = 0; at <= relative.size();) {
    const size_t end = std::min(relative.find('/', at), relative.size());
    const std::string_view name = relative.substr(at, end - at);
    if (!is_plain_name(name)) return std::nullopt;
    path /= name;
    at = end + 1;
  }
  std::error_code missing;
  const fs::path real = fs::canonical(path, missing);
  if (missing || !is_file(real)) return std::nullopt;
  const fs::path root = fs::canonical(folder, missing);
  if (missing || std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
    return std::nullopt;
  return real;
}

}  // namespace

Result<Catalog> Catalog::open(const std::vector<fs::path>& packs, const fs::path& page) {
  Catalog catalog;
  for (const fs::path& path : packs) {
    std::error_code missing;
    if (fs::is_directory(path, missing)) {
      catalog.folders_.push_back(path);
      continue;
    }
    if (!is_file(path)) return fail({path.string(), "", "there is no such file or folder", ErrorKind::io});
    const bool twice =
        std::ranges::any_of(catalog.files_, [&](const fs::path& other) { return other.filename() == path.filename(); });
    if (twice) return fail({path.string(), "", "another pack has the same name"});
    LW_CHECK(PackReader::open_file(path.string()));
    catalog.files_.push_back(path);
  }
  std::error_code missing;
  if (!page.empty() && !fs::is_directory(page, missing))
    return fail({page.string(), "", "there is no such folder", ErrorKind::io});
  catalog.page_ = page;
  return catalog;
}

std::vector<Catalog::Pack> Catalog::packs() const {
  std::map<std::string, fs::path> found;
  for (const fs::path& file : files_) found.emplace(file.filename().string(), file);
  for (const fs::path& folder : folders_)
    for (const fs::path& file : packs_in(folder)) found.emplace(file.filename().string(), file);
  std::vector<Pack> packs;
  for (const auto& [name, file] : found) {
    std::error_code gone;
    const uint64_t bytes = fs::file_size(file, gone);
    if (!gone) packs.push_back({name, file, bytes});
  }
  return packs;
}

std::vector<fs::path> Catalog::empty_folders() const {
  std::vector<fs::path> empty;
  for (const fs::path& folder : folders_)
    if (packs_in(folder).empty()) empty.push_back(folder);
  return empty;
}

std::string Catalog::packs_json() const {
  std::string json = "{\"packs\":[";
  for (const Pack& pack : packs()) {
    if (json.back() == '}') json += ',';
    json += "{\"name\":" + json_string(pack.name) + ",\"url\":\"" + std::string(pack_prefix) +
            encode_percent(pack.name) + "\",\"bytes\":" + std::to_string(pack.bytes) + "}";
  }
  return json + "]}\n";
}

std::optional<fs::path> Catalog::file(std::string_view url_path) const {
  const std::optional<std::string> path = decode_percent(url_path);
  if (!path || path->empty() || path->front() != '/') return std::nullopt;
  if (path->starts_with(pack_prefix)) {
    const std::string name = path->substr(pack_prefix.size());
    for (const fs::path& file : files_)
      if (file.filename() == name && is_file(file)) return file;
    for (const fs::path& folder : folders_) {
      const fs::path file = folder / name;
      if (is_pack_name(name) && is_file(file)) return file;
    }
    return std::nullopt;
  }
  if (page_.empty()) return std::nullopt;
  return file_below(page_, *path == "/" ? "index.html" : std::string_view(*path).substr(1));
}

std::string_view content_type(const fs::path& file) {
  static const std::map<std::string, std::string_view> types = {
      {".css", "text/css; charset=utf-8"},        {".glb", "model/gltf-binary"}, {".gltf", "model/gltf+json"},
      {".html", "text/html; charset=utf-8"},      {".ico", "image/x-icon"},      {".jpg", "image/jpeg"},
      {".js", "text/javascript; charset=utf-8"},  {".json", "application/json"}, {".map", "application/json"},
      {".mjs", "text/javascript; charset=utf-8"}, {".png", "image/png"},         {".svg", "image/svg+xml"},
      {".txt", "text/plain; charset=utf-8"},      {".wasm", "application/wasm"}, {".webp", "image/webp"},
  };
  const auto found = types.find(file.extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

}  // namespace lightwell
