// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// Constants and limits of the container (docs/format.md). A file that exceeds a limit is refused before anything is
/// allocated for it.
constexpr uint32_t format_version = 0;
constexpr uint32_t rows_per_page = 64;
constexpr uint32_t row_bytes = 12;  ///< a row of a block table
constexpr uint32_t block_check_bytes = 4;
constexpr uint32_t max_block_bytes = 16u << 20;  ///< of a block, including its check
constexpr uint32_t max_directory_bytes = 64u << 20;
constexpr uint32_t max_streams = 65536;
constexpr uint32_t max_parameter_bytes = 65536;  ///< of a stream's parameters
constexpr uint32_t max_stream_blocks = 1u << 22;

/// 128 bits that identify the content of a pack: the XXH3-128 of the opening's BIN data, the directory's streams and
/// all payloads, in canonical byte order.
using PackId = std::array<uint8_t, 16>;

/// The id as 32 hexadecimal digits.
std::string to_text(const PackId& id);

enum class StreamKind : uint8_t {
  light = 0,
  mesh = 1,
  texture = 2,
  bricks = 3,  ///< finer cells of a part of a light grid, whose stream comes before
  parts = 4    ///< what the file said of the parts that meshes were merged from
};
constexpr int stream_kinds = 5;
constexpr bool is_light(StreamKind kind) { return kind == StreamKind::light || kind == StreamKind::bricks; }

/// A row of a block table.
struct BlockRow {
  uint32_t length = 0;  ///< bytes in the file, including the check
  uint32_t adds = 0;    ///< vertices, nodes or bytes, depending on the kind
  float error = 0;      ///< remaining after this block, in the kind's own unit; finite, not negative

  bool operator==(const BlockRow&) const = default;
};

/// A stream as the directory lists it.
struct StreamEntry {
  StreamKind kind = StreamKind::light;
  uint8_t codec = 0;    ///< each kind numbers its own
  uint32_t first = 0;   ///< where its first block begins, in bytes from the start of the LWST chunk's data
  uint32_t length = 0;  ///< bytes of all its blocks and table pages, including checks
  uint32_t blocks = 0;
  float error = 0;                  ///< before the first block: that of what the opening shows
  std::vector<uint8_t> parameters;  ///< the kind's own header
  std::vector<BlockRow> rows;       ///< the first page of the block table: min(blocks, 64) rows

  bool operator==(const StreamEntry&) const = default;
};

/// The head of the LWST chunk: everything a client needs to find, check and order the blocks.
struct Directory {
  PackId id{};
  uint32_t opening_length = 0;  ///< bytes of the file before the LWST chunk's data
  uint32_t opening_check = 0;   ///< CRC-32C of those bytes
  std::vector<StreamEntry> streams;

  /// Length in bytes when written.
  size_t byte_length() const;
  std::vector<uint8_t> write() const;
  /// The streams alone as they are written, which is what the id covers of the directory.
  std::vector<uint8_t> write_streams() const;

  /// Reads a directory in a file of `file_length` bytes. Fails for a wrong version or check, an exceeded limit, streams
  /// that do not follow the directory one after another and fill the file, and rows that do not fit into their stream.
  static Result<Directory> read(Bytes bytes, uint64_t file_length);

  bool operator==(const Directory&) const = default;
};

/// The check at the end of a block or table page: the CRC-32C of its payload, seeded with the pack's id so that blocks
/// of other packs fail it.
uint32_t block_check(Bytes payload, const PackId& id);

/// The payload of a block or page, given as it lies in the file; empty when its check fails or it has no payload.
Bytes checked_payload(Bytes block, const PackId& id);

/// The kind's name in messages and reports: "light", "mesh", "texture", "bricks" or "parts".
const char* to_text(StreamKind kind);

}  // namespace lightwell
