// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "lightwell/pack/block_table.h"
#include "lightwell/pack/directory.h"

namespace lightwell {

/// Returns `length` bytes of a file from position `first`, or an error. Must be thread-safe if threads read blocks of
/// one reader concurrently.
using FetchBytes = std::function<Result<std::vector<uint8_t>>(uint64_t first, uint64_t length)>;

/// Reads a pack block by block with all checks, for programs that wait for their bytes (info, verify, export). The
/// const functions are thread-safe if the FetchBytes is, as that of open_file is.
class PackReader {
 public:
  /// Reads the opening, the directory and all table pages.
  static Result<PackReader> open(FetchBytes fetch, uint64_t file_length);
  /// Opens a pack file. Only the opening, the tables and the blocks being read are in memory.
  static Result<PackReader> open_file(const std::string& path);

  const Directory& directory() const { return directory_; }
  /// The opening as a standalone GLB: header, JSON, BIN.
  const std::vector<uint8_t>& opening() const { return opening_; }
  /// The whole block table of a stream.
  const std::vector<BlockRow>& rows(size_t stream) const { return tables_[stream].rows(); }
  /// The payload of a block; an error names stream and block.
  Result<std::vector<uint8_t>> block(size_t stream, uint32_t index) const;
  /// Reads all payloads and fails when their hash is not the pack's id.
  Result<void> verify_id() const;

 private:
  PackReader() = default;
  Result<std::vector<uint8_t>> payload(size_t stream, uint32_t extent) const;

  FetchBytes fetch_;
  Directory directory_;
  std::vector<uint8_t> opening_;
  std::vector<BlockTable> tables_;
};

/// Whether the chunk headers are those of a pack: JSON, BIN (optional) and LWST. The contents are not checked. False
/// when the bytes cannot be read.
bool is_pack(const FetchBytes& fetch);
/// The same for a file.
bool is_pack_file(const std::string& path);

}  // namespace lightwell
