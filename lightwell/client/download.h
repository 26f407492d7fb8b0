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

/// The file position of the next byte of a body, and the start of an extent that is not complete yet.
struct Cursor {
  uint64_t position = 0;
  std::vector<uint8_t> partial;
};

/// The part of the file that has arrived. Bytes may arrive in any order and more than once; only those that pass their
/// check count. After a first failed check an extent counts as missing; a second one is an error. What to request next
/// is decided by client/run_order.h.
class Download {
 public:
  /// Takes the next bytes of a body and moves its cursor. Returns the number of valid bytes gained.
  Result<uint64_t> receive(Cursor& cursor, Bytes bytes);

  /// True when the opening and the directory have arrived.
  bool opened() const { return directory_.has_value(); }
  /// Before that: the range [begin, end) of the file to request.
  std::pair<uint64_t, uint64_t> wanted_head() const;
  /// Forgets failed checks, and what has come of an opening that is not complete: the bytes were not those of the
  /// file's places that were asked for.
  void forget_damage();
  /// The length of the file, 0 while unknown.
  uint64_t file_length() const { return size_.file_length; }
  /// True when a block was damaged or suspect() was called, so that the start of the directory should be read again to
  /// learn whether the file is still the same.
  bool suspicious() const { return suspicious_; }
  void suspect() { suspicious_ = true; }
  /// The range to request in that case.
  std::pair<uint64_t, uint64_t> wanted_witness() const;
  /// True when the directory on the server is no longer the same.
  bool replaced() const { return replaced_; }

  // The following require opened().
  const Directory& directory() const { return *directory_; }
  const std::vector<uint8_t>& opening() const { return opening_; }
  const BlockTable& table(size_t stream) const { return streams_[stream].table; }
  /// Bytes of the stream that have arrived.
  uint64_t received(size_t stream) const { return streams_[stream].received; }
  /// Bytes of checked blocks that have not been taken.
  uint64_t backlog() const { return backlog_; }

  /// True when a known extent of the stream has arrived.
  bool here(size_t stream, uint32_t extent) const { return streams_[stream].here[extent]; }

  /// True when the stream's next block has arrived.
  bool ready(size_t stream) const;
  /// Takes its payload.
  std::vector<uint8_t> take(size_t stream);
  /// Number of blocks taken.
  uint32_t taken(size_t stream) const { return streams_[stream].next; }
  bool complete(size_t stream) const { return taken(stream) == table(stream).blocks(); }

 private:
  struct Stream {
    BlockTable table;
    std::vector<uint8_t> here;                       ///< 1 for each known extent that has arrived, else 0
    std::map<uint32_t, std::vector<uint8_t>> ready;  ///< blocks that have arrived but were not taken
    uint32_t next = 0;                               ///< the next block to take
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
  std::vector<uint8_t> witness_;     ///< the directory's length, version and id
  std::vector<uint8_t> read_again_;  ///< the same fields as far as they have been read again
  std::vector<uint8_t> another_;     ///< the different fields read the last time
  std::vector<Stream> streams_;
  std::map<std::pair<size_t, uint32_t>, int> strikes_;
  uint64_t backlog_ = 0;
  bool suspicious_ = false;
  bool replaced_ = false;
};

}  // namespace lightwell
