// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightwell/server/open_file.h"

namespace lightwell {

/// A pack that a server gives, under its file's name.
struct ServedPack {
  std::string name;
  uint64_t bytes = 0;
};

/// The packs of a folder as it is when somebody asks: regular files whose names end in .glb and are not hidden, which
/// begin as packs do and, when they are links, lead to a file below the folder.
///
/// Whether a file is a pack is remembered until its place, length or time of change is another one: a listing opens new
/// files only, and needs a system call for each of the others. For one thread at a time.
class PackFolder {
 public:
  explicit PackFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  /// All packs, in no order; none when the folder is not there. Fails with ErrorKind::limit when the system has no
  /// descriptors left.
  Result<std::vector<ServedPack>> packs();
  /// Opens a pack. Fails with ErrorKind::limit as above, with io when there is no pack of that name.
  Result<OpenFile> open(std::string_view name);

 private:
  /// What tells that a file is still the same: device, file, length, seconds and nanoseconds of the last change.
  using Identity = std::array<uint64_t, 5>;
  struct Known {
    Identity identity{};
    bool is_pack = false;
  };

  static Identity identity_of(const struct stat& status);
  bool is_pack(const OpenFile& file, const std::string& name);

  std::filesystem::path folder_;
  std::map<std::string, Known> known_;  ///< by name
};

/// Whether a name stays in its folder and is not hidden.
bool is_plain_name(std::string_view name);

/// The real place of a regular file that is named by a path of plain names below a folder. Nothing when it is not
/// there, or when a link on the way leads out of the folder.
std::optional<std::filesystem::path> file_below(const std::filesystem::path& folder, std::string_view relative);

}  // namespace lightwell
