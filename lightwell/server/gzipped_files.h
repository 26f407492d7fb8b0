// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include "lightwell/server/open_file.h"

namespace lightwell {

/// The gzipped contents of files, made when one is asked for first and kept in memory until the file has changed. For
/// one thread at a time.
class GzippedFiles {
 public:
  /// The content as a gzip member (RFC 1952). Nothing when that is no shorter, when the file is longer than 2 MiB,
  /// which would hold up others, or when it cannot be read. All contents together take at most 16 MiB.
  std::shared_ptr<const std::string> content(const OpenFile& file);

 private:
  std::map<std::string, std::shared_ptr<const std::string>> contents_;  ///< by the tag of the file; null: not worth it
  size_t bytes_ = 0;
};

}  // namespace lightwell
