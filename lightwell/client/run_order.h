// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lightwell/client/download.h"

namespace lightwell {

/// Consecutive extents of a stream that have neither arrived nor been requested.
struct Run {
  size_t stream = 0;
  uint32_t first = 0;  ///< number of the first extent
  uint32_t count = 0;
  uint64_t begin = 0;  ///< file position
  uint64_t end = 0;
};

/// The order in which the extents of each stream are requested. The download knows which have arrived; this class alone
/// knows which have been requested, and which come next.
class RunOrder {
 public:
  /// The download must outlive the order. All other functions require it to be opened().
  explicit RunOrder(const Download& download) : download_(download) {}

  const Download& download() const { return download_; }

  /// The first missing extents of a stream: at least one, and more up to `length` bytes; nullopt when no known extent
  /// is missing. A table page that lies less than `ahead` bytes after the first missing extent comes first.
  std::optional<Run> missing(size_t stream, uint64_t length, uint64_t ahead);
  /// Marks a run as requested, so that it is not missing.
  void asked(const Run& run);
  /// Marks the extents of a run that have not arrived as missing again.
  void unasked(const Run& run);

 private:
  struct Stream {
    std::vector<uint8_t> asked;  ///< 1 for each extent that has been requested, else 0
    uint32_t first_missing = 0;  ///< no extent before it is missing
  };

  Stream& follow(size_t stream);
  bool is_missing(size_t stream, uint32_t extent) const;

  const Download& download_;
  std::vector<Stream> streams_;
};

}  // namespace lightwell
