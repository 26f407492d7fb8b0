// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "lightwell/pack/block_table.h"
#include "lightwell/pack/directory.h"

namespace lightwell {

/// Gives `length` bytes of a file from position `first` on, or says why it cannot. Threads may call it at the same time
/// wherever they read blocks of one reader at the same time.
using FetchBytes = std::function<Result<std::vector<uint8_t>>(uint64_t first, uint64_t length)>;

/// Reads a pack block by block with every check, for programs that wait for their bytes (info, verify, export).
/// Threads may call the const functions of one reader at the same time when its FetchBytes may be called so, as that of
/// open_file may.
class PackReader {
 public:
  /// Reads the opening, the directory and all table pages.
  static Result<PackReader> open(FetchBytes fetch, uint64_t file_length);
  /// Reads a pack from a file; at most a block of it is in memory at a time. Its reads are positional.
  static Result<PackReader> open_file(const std::string& path);

  const Directory& directory() const { return directory_; }
  /// The opening as a GLB of its own: header, JSON, BIN.
  const std::vector<uint8_t>& opening() const { return opening_; }
  /// The whole block table of a stream.
  const std::vector<BlockRow>& rows(size_t stream) const { return tables_[stream].rows(); }
  /// The payload of a block; an error names stream and block.
  Result<std::vector<uint8_t>> block(size_t stream, uint32_t index) const;
  /// Reads everything and fails when the content is not what the pack's id says.
  Result<void> verify_id() const;

 private:
  PackReader() = default;
  Result<std::vector<uint8_t>> payload(size_t stream, uint32_t extent) const;

  FetchBytes fetch_;
  Directory directory_;
  std::vector<uint8_t> opening_;
  std::vector<BlockTable> tables_;
};

/// Whether bytes are those of a pack, as far as their headers say: the chunks are JSON, BIN and LWST. What is in them
/// may be damaged. False also when they cannot be read.
bool is_pack(const FetchBytes& fetch);
/// The same of a file.
bool is_pack_file(const std::string& path);

}  // namespace lightwell
