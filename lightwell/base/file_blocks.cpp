// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file_blocks.h"

#include <algorithm>

namespace lightwell {

std::vector<Bytes> file_blocks(Bytes file) {
  std::vector<Bytes> blocks;
  for (size_t at = 0; at < file.size(); at += file_block_bytes)
    blocks.push_back(file.subspan(at, std::min(file_block_bytes, file.size() - at)));
  return blocks;
}

Result<void> FileBlocks::append(Bytes block) {
  const size_t due = std::min(file_block_bytes, bytes_ - file_.size());
  if (block.size() != due) return fail("block of a file", "wrong length");
  file_.insert(file_.end(), block.begin(), block.end());
  return {};
}

}  // namespace lightwell
