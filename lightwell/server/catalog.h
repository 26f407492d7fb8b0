// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightwell/base/result.h"

namespace lightwell {

/// What a server has to give: packs by name, and the files of the page. Folders are looked at when somebody asks, so a
/// pack that is added to one is served at once. Nothing outside of what was named is ever given.
class Catalog {
 public:
  /// `packs`: packs, or folders whose *.glb are meant; a pack's name is its file name. `page`: the folder of the page,
  /// or empty. Fails when one does not exist, a file is no pack, or two files have the same name.
  static Result<Catalog> open(const std::vector<std::filesystem::path>& packs, const std::filesystem::path& page);

  struct Pack {
    std::string name;
    std::filesystem::path file;
    uint64_t bytes = 0;
  };
  /// All packs, by name. Of a folder, other *.glb are left out.
  std::vector<Pack> packs() const;
  /// Those of the folders that hold no pack so far.
  std::vector<std::filesystem::path> empty_folders() const;
  /// The list as JSON: {"packs": [{"name": ..., "url": "/packs/...", "bytes": ...}, ...]}.
  std::string packs_json() const;

  /// The file behind the path of a URL, percent-encoded, without the query: "/packs/NAME" a pack, "/" the page's
  /// index.html, anything else a file below the page's folder. Nothing when there is no such regular file.
  std::optional<std::filesystem::path> file(std::string_view url_path) const;

 private:
  std::vector<std::filesystem::path> files_;
  std::vector<std::filesystem::path> folders_;
  std::filesystem::path page_;
};

/// The Content-Type of a file, by its name's ending.
std::string_view content_type(const std::filesystem::path& file);

}  // namespace lightwell
