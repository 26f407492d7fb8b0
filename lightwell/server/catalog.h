// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightwell/server/gzipped_files.h"
#include "lightwell/server/pack_folder.h"

namespace lightwell {

/// All that a server gives: packs by name, and the files of the page. Folders are looked at when somebody asks, so a
/// pack that is added to one is served at once. Nothing outside of what was named is ever given. For one thread at a
/// time.
class Catalog {
 public:
  /// `packs`: packs, or folders of packs (see PackFolder); a pack's name is its file name. `page`: the folder of the
  /// page, or empty. `packs_change`: the list says that the page is to look out for packs that are replaced. Fails when
  /// one does not exist, a file is no pack, or two files have the same name.
  static Result<Catalog> open(const std::vector<std::filesystem::path>& packs, const std::filesystem::path& page,
                              bool packs_change = false);

  /// All packs, in the order of their names; of two with one name the first that was given. Fails as PackFolder does.
  Result<std::vector<ServedPack>> packs();
  /// Those of the folders that hold no pack so far.
  std::vector<std::filesystem::path> empty_folders();
  /// The list as JSON: {"packs": [{"name": ..., "url": "/packs/...", "bytes": ...}, ...], "change": true}, the last
  /// only where packs change. Given again for up to a second while no name has come or gone in the folders.
  Result<std::shared_ptr<const std::string>> packs_json();

  struct File {
    OpenFile open;
    std::string_view type;      ///< the Content-Type, by the ending of the file's name
    bool compressible = false;  ///< a text or program of the page
  };
  /// Opens the file behind the path of a URL, percent-encoded, without the query: "/packs/NAME" a pack, "/" the page's
  /// index.html, anything else a file below the page's folder. Fails with ErrorKind::limit when the system has no
  /// descriptors left, with another kind when there is no such file.
  Result<File> file(std::string_view url_path);
  /// The gzipped content of a file, null when it is not to be had (see GzippedFiles).
  std::shared_ptr<const std::string> gzipped(const OpenFile& file) { return gzipped_.content(file); }

 private:
  using FolderTimes = std::vector<std::filesystem::file_time_type>;
  struct List {
    std::shared_ptr<const std::string> json;
    std::chrono::steady_clock::time_point good_until;
    FolderTimes times;  ///< when each folder was changed last
  };
  FolderTimes folder_times() const;
  Result<OpenFile> pack(const std::string& name);

  std::vector<std::filesystem::path> files_;
  std::vector<PackFolder> folders_;
  std::filesystem::path page_;
  bool packs_change_ = false;
  List list_;
  GzippedFiles gzipped_;
};

}  // namespace lightwell
