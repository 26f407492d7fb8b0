// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/catalog.h"

#include <algorithm>
#include <map>
#include <optional>

#include "lightwell/base/hex.h"
#include "lightwell/pack/reader.h"

namespace lightwell {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view pack_prefix = "/packs/";
constexpr std::chrono::seconds list_age(1);
constexpr std::chrono::milliseconds clock_grain(50);  // of most file systems less; 10 ms is common

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

bool is_file(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

std::string_view content_type(const fs::path& name) {
  static const std::map<std::string, std::string_view> types = {
      {".css", "text/css; charset=utf-8"},        {".glb", "model/gltf-binary"}, {".gltf", "model/gltf+json"},
      {".html", "text/html; charset=utf-8"},      {".ico", "image/x-icon"},      {".jpg", "image/jpeg"},
      {".js", "text/javascript; charset=utf-8"},  {".json", "application/json"}, {".map", "application/json"},
      {".mjs", "text/javascript; charset=utf-8"}, {".png", "image/png"},         {".svg", "image/svg+xml"},
      {".txt", "text/plain; charset=utf-8"},      {".wasm", "application/wasm"}, {".webp", "image/webp"},
  };
  const auto found = types.find(name.extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

bool is_compressible(std::string_view type) {
  return type.starts_with("text/") || type == "application/json" || type == "application/wasm" ||
         type == "image/svg+xml" || type == "model/gltf+json";
}

}  // namespace

Result<Catalog> Catalog::open(const std::vector<fs::path>& packs, const fs::path& page, bool packs_change) {
  Catalog catalog;
  catalog.packs_change_ = packs_change;
  for (const fs::path& path : packs) {
    std::error_code missing;
    if (fs::is_directory(path, missing)) {
      LW_CHECK(catalog.folders_.emplace_back(path).packs());
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

Result<std::vector<ServedPack>> Catalog::packs() {
  std::map<std::string, uint64_t> found;
  for (const fs::path& file : files_) {
    std::error_code gone;
    const uint64_t bytes = fs::file_size(file, gone);
    if (!gone) found.emplace(file.filename().string(), bytes);
  }
  for (PackFolder& folder : folders_) {
    LW_TRY(packs, folder.packs());
    for (ServedPack& pack : packs) found.emplace(std::move(pack.name), pack.bytes);
  }
  std::vector<ServedPack> packs;
  for (const auto& [name, bytes] : found) packs.push_back({name, bytes});
  return packs;
}

std::vector<fs::path> Catalog::empty_folders() {
  std::vector<fs::path> empty;
  for (PackFolder& folder : folders_)
    if (const auto packs = folder.packs(); packs && packs->empty()) empty.push_back(folder.path());
  return empty;
}

Catalog::FolderTimes Catalog::folder_times() const {
  FolderTimes times;
  for (const PackFolder& folder : folders_) {
    std::error_code gone;
    times.push_back(fs::last_write_time(folder.path(), gone));
  }
  return times;
}

Result<std::shared_ptr<const std::string>> Catalog::packs_json() {
  const auto now = std::chrono::steady_clock::now();
  FolderTimes times = folder_times();
  if (now < list_.good_until && times == list_.times) return list_.json;
  LW_TRY(packs, this->packs());
  std::string json = "{\"packs\":[";
  for (const ServedPack& pack : packs) {
    if (json.back() == '}') json += ',';
    json += "{\"name\":" + json_string(pack.name) + ",\"url\":\"" + std::string(pack_prefix) +
            encode_percent(pack.name) + "\",\"bytes\":" + std::to_string(pack.bytes) + "}";
  }
  list_.json = std::make_shared<const std::string>(json + (packs_change_ ? "],\"change\":true}\n" : "]}\n"));
  // A folder that changes twice within the grain of its file system's clock shows one time.
  const auto settled = fs::file_time_type::clock::now() - clock_grain;
  const bool telling = std::ranges::all_of(times, [&](auto time) { return time < settled; });
  list_.good_until = telling ? now + list_age : now;
  list_.times = std::move(times);
  return list_.json;
}

Result<OpenFile> Catalog::pack(const std::string& name) {
  for (const fs::path& file : files_)
    if (file.filename() == name && is_file(file)) return OpenFile::open(file);
  Result<OpenFile> pack = fail(ErrorKind::io, name, "there is no such pack");
  for (PackFolder& folder : folders_) {
    pack = folder.open(name);
    if (pack || pack.error().kind == ErrorKind::limit) break;
  }
  return pack;
}

Result<Catalog::File> Catalog::file(std::string_view url_path) {
  const std::optional<std::string> path = decode_percent(url_path);
  if (!path || path->empty() || path->front() != '/') return fail("", "is no path of a URL");
  if (path->starts_with(pack_prefix)) {
    LW_TRY(open, pack(path->substr(pack_prefix.size())));
    return File{std::move(open), content_type(*path), false};
  }
  const std::string name = *path == "/" ? "index.html" : path->substr(1);
  const auto place = page_.empty() ? std::nullopt : file_below(page_, name);
  if (!place) return fail(ErrorKind::io, name, "there is no such file");
  LW_TRY(open, OpenFile::open(*place));
  const std::string_view type = content_type(name);
  return File{std::move(open), type, is_compressible(type)};
}

}  // namespace lightwell
