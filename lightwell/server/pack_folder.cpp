// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/pack_folder.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "lightwell/pack/reader.h"

namespace lightwell {
namespace fs = std::filesystem;
namespace {

bool is_pack_name(std::string_view name) { return is_plain_name(name) && name.ends_with(".glb"); }

/// Reads from the file that is open already, so that it is the same one and needs no further descriptor.
FetchBytes bytes_of(const OpenFile& file) {
  return [descriptor = file.descriptor()](uint64_t first, uint64_t length) -> Result<std::vector<uint8_t>> {
    std::vector<uint8_t> bytes(length);
    if (::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(first)) != static_cast<ssize_t>(length))
      return fail({"", std::to_string(length) + " bytes", "cannot be read", ErrorKind::io, first});
    return bytes;
  };
}

}  // namespace

bool is_plain_name(std::string_view name) {
  return !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string_view::npos &&
         name.find('\0') == std::string_view::npos;
}

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
  if (missing || !fs::is_regular_file(real, missing)) return std::nullopt;
  const fs::path root = fs::canonical(folder, missing);
  if (missing || std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
    return std::nullopt;
  return real;
}

PackFolder::Identity PackFolder::identity_of(const struct stat& status) {
  return {static_cast<uint64_t>(status.st_dev), static_cast<uint64_t>(status.st_ino),
          static_cast<uint64_t>(status.st_size), static_cast<uint64_t>(status.st_mtim.tv_sec),
          static_cast<uint64_t>(status.st_mtim.tv_nsec)};
}

bool PackFolder::is_pack(const OpenFile& file, const std::string& name) {
  const Identity identity = identity_of(file.status());
  const auto known = known_.find(name);
  if (known != known_.end() && known->second.identity == identity) return known->second.is_pack;
  const bool is_one = lightwell::is_pack(bytes_of(file));
  known_[name] = {identity, is_one};
  return is_one;
}

Result<OpenFile> PackFolder::open(std::string_view name) {
  const Error absent((folder_ / name).string(), "", "there is no such pack", ErrorKind::io);
  if (!is_pack_name(name)) return fail(absent);
  const std::optional<fs::path> place = file_below(folder_, name);
  if (!place) return fail(absent);
  LW_TRY(file, OpenFile::open(*place));
  if (!is_pack(file, std::string(name))) return fail(absent);
  return std::move(file);
}

Result<std::vector<ServedPack>> PackFolder::packs() {
  std::vector<ServedPack> packs;
  std::map<std::string, Known> still_there;
  std::error_code code;
  for (fs::directory_iterator entry(folder_, code), end; !code && entry != end; entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    if (!is_pack_name(name)) continue;
    std::error_code unknown;
    const auto place = entry->is_symlink(unknown) ? file_below(folder_, name) : std::optional(entry->path());
    struct stat status {};
    if (!place || ::stat(place->c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    auto known = known_.find(name);
    if (known == known_.end() || known->second.identity != identity_of(status)) {
      const auto file = open(name);
      if (!file && file.error().kind == ErrorKind::limit) return fail(file.error());
      known = known_.find(name);
      if (known == known_.end() || known->second.identity != identity_of(status))
        continue;  // it cannot be read, or changes
    }
    if (known->second.is_pack) packs.push_back({name, known->second.identity[2]});
    still_there.insert(*known);
  }
  known_ = std::move(still_there);
  if (code && file_error(folder_, code.value()).kind == ErrorKind::limit)
    return fail(file_error(folder_, code.value()));
  return packs;
}

}  // namespace lightwell
