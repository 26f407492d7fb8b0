// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/pack/block_table.h"
#include "lightwell/pack/directory.h"
#include "lightwell/pack/opening.h"

namespace lightwell {

/// The place in the file where the next byte of a body belongs, and the beginning of an extent that is not whole yet.
struct Cursor {
  uint64_t position = 0;
  std::vector<uint8_t> partial;
};

/// The file as far as it has arrived. Bytes may come in any order and more than once; only what passes its check
/// counts. A check that fails twice at the same place is an error; after a first failure the place counts as not
/// here. What has been asked for, and what is asked next, is the business of client/run_order.h.
class Download {
 public:
  /// Takes bytes of a body and moves its cursor. Gives the number of good bytes gained.
  Result<uint64_t> receive(Cursor& cursor, Bytes bytes);

  /// True when opening and directory are there.
  bool opened() const { return directory_.has_value(); }
  /// Before that: the bytes begin ... end-1 of the file to ask for.
  std::pair<uint64_t, uint64_t> wanted_head() const;
  /// The length of the file, 0 while unknown.
  uint64_t file_length() const { return size_.file_length; }
  /// True when a block was damaged, or somebody called suspect(), and the directory should be read again, to learn
  /// whether the file is still the same one.
  bool suspicious() const { return suspicious_; }
  void suspect() { suspicious_ = true; }
  /// The bytes to ask for in that case.
  std::pair<uint64_t, uint64_t> wanted_witness() const;
  /// True when the directory that the server has now is another one.
  bool replaced() const { return replaced_; }

  // The rest needs opened().
  const Directory& directory() const { return *directory_; }
  const std::vector<uint8_t>& opening() const { return opening_; }
  const BlockTable& table(size_t stream) const { return streams_[stream].table; }
  /// Bytes of the stream that have arrived.
  uint64_t received(size_t stream) const { return streams_[stream].received; }
  /// Bytes of checked blocks that nobody has taken.
  uint64_t backlog() const { return backlog_; }

  /// True when a known extent of the stream has arrived.
  bool here(size_t stream, uint32_t extent) const { return streams_[stream].here[extent]; }

  /// True when the stream's next block, in its order, is there.
  bool ready(size_t stream) const;
  /// Takes its payload.
  std::vector<uint8_t> take(size_t stream);
  /// Number of blocks taken.
  uint32_t taken(size_t stream) const { return streams_[stream].next; }
  bool complete(size_t stream) const { return taken(stream) == table(stream).blocks(); }

 private:
  struct Stream {
    BlockTable table;
    std::vector<uint8_t> here;                       ///< 1 for each known extent that has arrived, 0 else
    std::map<uint32_t, std::vector<uint8_t>> ready;  ///< blocks that have arrived and were not taken
    uint32_t next = 0;                               ///< the block that is taken next
    uint64_t received = 0;
  };

  Result<uint64_t> receive_head(Cursor& cursor, Bytes& bytes);
  Result<void> open();
  uint64_t read_witness(Cursor& cursor, Bytes& bytes);
  Result<uint64_t> receive_extent(size_t stream, Cursor& cursor, Bytes& bytes);
  Result<uint64_t> accept(size_t stream, uint32_t index, Bytes bytes);
  Result<void> strike(size_t stream, const Extent& extent);
  std::optional<size_t> stream_at(uint64_t position) const;

  std::vector<uint8_t> head_;
  OpeningSize size_;
  bool head_failed_ = false;
  std::optional<Directory> directory_;
  std::vector<uint8_t> opening_;
  std::vector<uint8_t> witness_;     ///< the directory's first fields, its id among them
  std::vector<uint8_t> read_again_;  ///< the same, as far as they have been read again
  std::vector<uint8_t> another_;     ///< what was read instead the last time
  std::vector<Stream> streams_;
  std::map<std::pair<size_t, uint32_t>, int> strikes_;
  uint64_t backlog_ = 0;
  bool suspicious_ = false;
  bool replaced_ = false;
};

}  // namespace lightwell
