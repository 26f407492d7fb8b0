// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lightwell/pack/directory.h"

namespace lightwell {

/// The place in the file of a block or of a page of the block table.
struct Extent {
  bool page = false;
  uint32_t block = 0;   ///< number of the block, or of the first block in the page's rows
  uint64_t begin = 0;   ///< bytes from the start of the file
  uint32_t length = 0;  ///< bytes, including the check

  uint64_t end() const { return begin + length; }
};

/// The places of a stream's blocks and table pages ("extents"), as far as known: the page in the directory places the
/// first 64 blocks and the page after them, which places the next ones, and so on.
class BlockTable {
 public:
  /// Places the extents of the entry's rows; `data_begin` is the file position of the LWST chunk's data. Returns
  /// nullopt when they exceed the stream's length, or are all of the stream and do not fill it.
  static std::optional<BlockTable> place(const StreamEntry& entry, uint64_t data_begin);

  uint32_t blocks() const { return blocks_; }
  /// Number of extents in all, known or not.
  uint32_t extents() const { return blocks_ == 0 ? 0 : blocks_ + (blocks_ - 1) / rows_per_page; }
  /// Number of extents whose place is known: always a prefix.
  uint32_t known() const { return static_cast<uint32_t>(begins_.size()) - 1; }
  /// Extent i < known().
  Extent extent(uint32_t i) const;
  /// The known extent that contains the byte at `position` of the file.
  std::optional<uint32_t> at(uint64_t position) const;
  /// The rows of the blocks known so far.
  const std::vector<BlockRow>& rows() const { return rows_; }

  uint64_t begin() const { return begins_.front(); }
  uint64_t end() const { return end_; }

  /// Adds the rows of a page, given as the payload of the last known extent. Fails when they violate docs/format.md.
  Result<void> add_page(Bytes payload);

 private:
  BlockTable() = default;
  bool append(std::span<const BlockRow> rows);

  uint32_t blocks_ = 0;
  uint64_t end_ = 0;
  std::vector<BlockRow> rows_;
  std::vector<uint64_t> begins_;  ///< where each known extent begins, then where the last one ends
};

/// Reads `count` rows (length, adds, error); empty when one breaks a limit or the bytes are too few.
std::vector<BlockRow> read_rows(ByteReader& reader, uint32_t count);
void write_rows(ByteWriter& writer, std::span<const BlockRow> rows);

}  // namespace lightwell
