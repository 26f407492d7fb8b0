// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lightwell/server/byte_range.h"
#include "lightwell/server/catalog.h"

namespace lightwell {

/// A file that is open for reading, closed with the object.
class OpenFile {
 public:
  OpenFile() = default;
  /// Opens a regular file; is_open() tells whether that worked.
  explicit OpenFile(const std::filesystem::path& path);
  OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)), stat_(other.stat_) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    stat_ = other.stat_;
    return *this;
  }
  ~OpenFile() {
    if (is_open()) ::close(descriptor_);
  }

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  uint64_t length() const { return static_cast<uint64_t>(stat_.st_size); }
  /// A strong entity tag, quoted: of device, file, length and time of the last change in nanoseconds.
  std::string etag() const;

 private:
  int descriptor_ = -1;
  struct stat stat_ {};
};

/// What of a request decides about its answer.
struct RequestHead {
  std::string method;
  std::string target;
  std::string range;
  std::string if_range;
  std::string if_none_match;
};

/// An answer, without the fields that belong to the connection.
struct Answer {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> fields;
  std::string text;  ///< the body, unless it is a part of a file
  OpenFile file;     ///< when open: the body is bytes first ... first + length - 1 of it
  uint64_t first = 0;
  uint64_t length = 0;   ///< of the body; Content-Length
  bool has_body = true;  ///< false: for HEAD and for status 204 and 304

  void add(std::string name, std::string value) { fields.emplace_back(std::move(name), std::move(value)); }
};

/// Answers a request from a catalog.
Answer answer_request(const Catalog& catalog, const RequestHead& request);

/// A short plain text as an answer.
Answer answer_text(int status, std::string text, std::string type = "text/plain; charset=utf-8");

}  // namespace lightwell
