// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/gzipped_files.h"

#include <unistd.h>

#include <vector>

#include "lightwell/base/gzip.h"

namespace lightwell {
namespace {

constexpr uint64_t longest_file = 2u << 20;
constexpr size_t most_bytes = 16u << 20;
/// Of a file's place in the table, be its content worth compressing or not.
constexpr size_t bytes_of_entry = 128;

/// Empty when the file cannot be read.
std::vector<uint8_t> gzipped(const OpenFile& file) {
  std::vector<uint8_t> plain(file.length());
  if (::pread(file.descriptor(), plain.data(), plain.size(), 0) != static_cast<ssize_t>(plain.size())) return {};
  return gzip(plain);
}

}  // namespace

std::shared_ptr<const std::string> GzippedFiles::content(const OpenFile& file) {
  if (file.length() > longest_file) return nullptr;
  const auto known = contents_.find(file.etag());
  if (known != contents_.end()) return known->second;
  const std::vector<uint8_t> packed = gzipped(file);
  const bool worth_it = !packed.empty() && packed.size() < file.length();
  std::shared_ptr<const std::string> content;
  if (worth_it) content = std::make_shared<const std::string>(packed.begin(), packed.end());
  const size_t bytes = bytes_of_entry + (worth_it ? content->size() : 0);
  // What was kept for files that have changed since goes, too.
  if (bytes_ + bytes > most_bytes) {
    contents_.clear();
    bytes_ = 0;
  }
  bytes_ += bytes;
  contents_.emplace(file.etag(), content);
  return content;
}

}  // namespace lightwell
