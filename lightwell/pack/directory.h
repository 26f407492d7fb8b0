// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// Limits of the container (docs/format.md): a file beyond one of them is refused before anything is allocated for it.
constexpr uint32_t format_version = 0;
constexpr uint32_t rows_per_page = 64;
constexpr uint32_t row_bytes = 12;  ///< a row of a block table
constexpr uint32_t block_check_bytes = 4;
constexpr uint32_t max_block_bytes = 16u << 20;  ///< a block with its check
constexpr uint32_t max_directory_bytes = 64u << 20;
constexpr uint32_t max_streams = 65536;
constexpr uint32_t max_parameter_bytes = 65536;  ///< a stream's parameters
constexpr uint32_t max_stream_blocks = 1u << 22;

/// 128 bits that name the content of a pack: XXH3-128 of the opening's BIN data and of all payloads, canonical byte
/// order.
using PackId = std::array<uint8_t, 16>;

/// 32 hexadecimal digits.
std::string to_text(const PackId& id);

enum class StreamKind : uint8_t { light = 0, mesh = 1, texture = 2 };

/// A row of a block table.
struct BlockRow {
  uint32_t length = 0;  ///< bytes in the file, the check included
  uint32_t adds = 0;    ///< vertices, nodes or bytes, by the stream's kind
  float error = 0;      ///< what remains after this block, in the kind's own unit; finite, not negative

  bool operator==(const BlockRow&) const = default;
};

/// A stream as the directory lists it.
struct StreamEntry {
  StreamKind kind = StreamKind::light;
  uint8_t codec = 0;    ///< numbered by the kind
  uint32_t first = 0;   ///< where its first block begins, in bytes from the start of the LWST chunk's data
  uint32_t length = 0;  ///< bytes of all its blocks and table pages, checks included
  uint32_t blocks = 0;
  float error = 0;                  ///< of what the opening shows, before the first block
  std::vector<uint8_t> parameters;  ///< the kind's own header
  std::vector<BlockRow> rows;       ///< the first page of the block table: min(blocks, 64) rows

  bool operator==(const StreamEntry&) const = default;
};

/// The first bytes of the LWST chunk: all that a client has to know to find, check and order every block.
struct Directory {
  PackId id{};
  uint32_t opening_length = 0;  ///< bytes of the file before the LWST chunk's data
  uint32_t opening_check = 0;   ///< CRC-32C of those bytes
  std::vector<StreamEntry> streams;

  /// Length in bytes when written.
  size_t byte_length() const;
  std::vector<uint8_t> write() const;

  /// Reads and checks a whole directory in a file of `file_length` bytes: its version and check, every limit, that the
  /// streams lie one after another behind the directory and within the file, and that the rows fit into them.
  static Result<Directory> read(Bytes bytes, uint64_t file_length);

  bool operator==(const Directory&) const = default;
};

/// The check at the end of a block or table page: the CRC-32C of its payload, seeded with the pack's id so that a block
/// of another pack never passes.
uint32_t block_check(Bytes payload, const PackId& id);

/// The payload of a block or page as it lies in the file; empty when its check fails or it has no payload.
Bytes checked_payload(Bytes block, const PackId& id);

/// The kind's name in messages and reports: "light", "mesh" or "texture".
const char* to_text(StreamKind kind);

}  // namespace lightwell
