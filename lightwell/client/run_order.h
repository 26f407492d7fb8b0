// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lightwell/client/download.h"

namespace lightwell {

/// Consecutive extents of a stream that are neither here nor asked for.
struct Run {
  size_t stream = 0;
  uint32_t first = 0;  ///< extent
  uint32_t count = 0;
  uint64_t begin = 0;  ///< file position
  uint64_t end = 0;
};

/// The order in which the extents of each stream are asked for. The download knows which bytes are here; this class
/// alone knows what has been asked for, and what comes next. A stream's extents may leave the download and arrive in
/// any order.
class RunOrder {
 public:
  /// The download must outlive the order. The other functions need its opened().
  explicit RunOrder(const Download& download) : download_(download) {}

  const Download& download() const { return download_; }

  /// The first missing extents of a stream, about `length` bytes of them and at least one; none when nothing known is
  /// missing. When less than `ahead` bytes of the stream are known and missing, its next table page comes first.
  std::optional<Run> missing(size_t stream, uint64_t length, uint64_t ahead);
  /// Marks a run as asked for, so that it is not missing.
  void asked(const Run& run);
  /// Marks what has not arrived of a run as missing again.
  void unasked(const Run& run);

 private:
  struct Stream {
    std::vector<uint8_t> asked;  ///< 1 for each extent that has been asked for, 0 else
    uint32_t first_missing = 0;  ///< no extent before it is missing
  };

  Stream& follow(size_t stream);
  bool is_missing(size_t stream, uint32_t extent) const;

  const Download& download_;
  std::vector<Stream> streams_;
};

}  // namespace lightwell
