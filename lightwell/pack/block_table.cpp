// SPDX-License-Identifier: Apache-2.0
#include "lightwell/pack/block_table.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

constexpr uint32_t extents_per_page = rows_per_page + 1;  // 64 blocks and the page after them

/// The fewest bytes that `blocks` blocks without a row can take: a row, a byte and a check for each, and a check for
/// each page.
uint64_t least_bytes(uint32_t blocks) {
  const uint32_t pages = (blocks + rows_per_page - 1) / rows_per_page;
  return uint64_t(blocks) * (row_bytes + 1 + block_check_bytes) + uint64_t(pages) * block_check_bytes;
}

}  // namespace

std::optional<BlockTable> BlockTable::place(const StreamEntry& entry, uint64_t data_begin) {
  BlockTable table;
  table.blocks_ = entry.blocks;
  table.begins_ = {data_begin + entry.first};
  table.end_ = table.begin() + entry.length;
  if (!table.append(entry.rows)) return std::nullopt;
  return table;
}

Extent BlockTable::extent(uint32_t i) const {
  LW_ASSERT(i < known());
  const uint32_t page = i / extents_per_page;
  Extent extent;
  extent.page = i % extents_per_page == rows_per_page;
  extent.block = i - page;
  extent.begin = begins_[i];
  extent.length = static_cast<uint32_t>(begins_[i + 1] - begins_[i]);
  return extent;
}

std::optional<uint32_t> BlockTable::at(uint64_t position) const {
  const auto behind = std::ranges::upper_bound(begins_, position);
  if (behind == begins_.begin() || behind == begins_.end()) return std::nullopt;
  return static_cast<uint32_t>(behind - begins_.begin()) - 1;
}

Result<void> BlockTable::add_page(Bytes payload) {
  const uint32_t count = std::min(blocks_ - static_cast<uint32_t>(rows_.size()), rows_per_page);
  ByteReader reader(payload);
  const std::vector<BlockRow> rows = read_rows(reader, count);
  if (rows.size() != count || reader.remaining() != 0 || !append(rows))
    return fail("table page at block " + std::to_string(rows_.size()), "its rows are not possible");
  return {};
}

/// Places the blocks of one page's rows and the page after them. False when they and the minimum that must follow
/// exceed the stream, or when they are the last ones and do not fill it.
bool BlockTable::append(std::span<const BlockRow> rows) {
  uint64_t at = begins_.back();
  for (const BlockRow& row : rows) begins_.push_back(at += row.length);
  rows_.insert(rows_.end(), rows.begin(), rows.end());
  const uint32_t unplaced = blocks_ - static_cast<uint32_t>(rows_.size());
  if (unplaced == 0) return at == end_;
  if (at + least_bytes(unplaced) > end_) return false;
  begins_.push_back(at + std::min(unplaced, rows_per_page) * row_bytes + block_check_bytes);
  return true;
}

std::vector<BlockRow> read_rows(ByteReader& reader, uint32_t count) {
  if (reader.remaining() / row_bytes < count) return {};
  std::vector<BlockRow> rows(count);
  for (BlockRow& row : rows) {
    row.length = reader.u32();
    row.adds = reader.u32();
    row.error = reader.f32();
    const bool possible =
        row.length > block_check_bytes && row.length <= max_block_bytes && row.error >= 0 && std::isfinite(row.error);
    if (!possible) return {};
  }
  return rows;
}

void write_rows(ByteWriter& writer, std::span<const BlockRow> rows) {
  for (const BlockRow& row : rows) {
    writer.u32(row.length);
    writer.u32(row.adds);
    writer.f32(row.error);
  }
}

}  // namespace lightwell
