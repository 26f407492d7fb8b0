// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/open_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace lightwell {

Result<OpenFile> OpenFile::open(const std::filesystem::path& path) {
  OpenFile file;
  // A pipe would be waited for without O_NONBLOCK.
  file.descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (!file.is_open() || ::fstat(file.descriptor_, &file.status_) != 0) return fail(file_error(path, errno));
  if (!S_ISREG(file.status_.st_mode)) return fail({path.string(), "", "is no regular file", ErrorKind::io});
  return file;
}

OpenFile::OpenFile(OpenFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), status_(other.status_) {}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(status_, other.status_);
  return *this;
}

OpenFile::~OpenFile() {
  if (is_open()) ::close(descriptor_);
}

std::string OpenFile::etag() const {
  std::string tag = "\"";
  for (const auto number :
       {static_cast<uint64_t>(status_.st_dev), static_cast<uint64_t>(status_.st_ino), length(),
        static_cast<uint64_t>(status_.st_mtim.tv_sec), static_cast<uint64_t>(status_.st_mtim.tv_nsec)}) {
    if (tag.size() > 1) tag += '-';
    tag += std::to_string(number);
  }
  return tag + '"';
}

Error file_error(const std::filesystem::path& path, int code) {
  const bool exhausted = code == EMFILE || code == ENFILE || code == ENOMEM;
  return {path.string(), "", std::generic_category().message(code), exhausted ? ErrorKind::limit : ErrorKind::io};
}

}  // namespace lightwell
