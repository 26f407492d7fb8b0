// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// A file that comes in blocks has so many bytes in each; the last may have fewer.
constexpr size_t file_block_bytes = 32768;

/// The blocks of a file, as views into it.
std::vector<Bytes> file_blocks(Bytes file);

/// Puts a file together from its blocks. Memory grows with what has arrived.
class FileBlocks {
 public:
  /// `bytes` is the size of the whole file.
  explicit FileBlocks(uint32_t bytes) : bytes_(bytes) {}

  /// Adds the next block. Fails, and stays as it was, when the block has not the length that is due.
  Result<void> append(Bytes block);
  /// True when every block has been added.
  bool complete() const { return file_.size() == bytes_; }
  /// What has arrived: when complete, the file.
  const std::vector<uint8_t>& file() const { return file_; }

 private:
  uint32_t bytes_;
  std::vector<uint8_t> file_;
};

}  // namespace lightwell
