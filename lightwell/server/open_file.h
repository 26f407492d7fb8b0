// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "lightwell/base/result.h"

namespace lightwell {

/// A regular file that is open for reading, closed with the object.
class OpenFile {
 public:
  /// Errors: ErrorKind::limit when the system has no descriptor or memory left, and io when there is no such file or it
  /// may not be read.
  static Result<OpenFile> open(const std::filesystem::path& path);

  OpenFile() = default;
  OpenFile(OpenFile&& other) noexcept;
  OpenFile& operator=(OpenFile&& other) noexcept;
  ~OpenFile();

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  uint64_t length() const { return static_cast<uint64_t>(status_.st_size); }
  const struct stat& status() const { return status_; }
  /// A strong entity tag (RFC 9110, 8.8.3), quoted: of device, file, length and time of the last change in nanoseconds.
  std::string etag() const;

 private:
  int descriptor_ = -1;
  struct stat status_ {};
};

/// The error of a file that cannot be opened or listed, of the kind that OpenFile::open gives it.
Error file_error(const std::filesystem::path& path, int code);

}  // namespace lightwell
