// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace lightwell {

/// The part of a file that a Range header asks for (RFC 9110, 14.2).
struct ByteRange {
  enum class Kind : uint8_t {
    whole,          ///< no range, one that is not understood, or several: the whole file, status 200
    part,           ///< bytes first ... first + length - 1, status 206
    unsatisfiable,  ///< beyond the file, status 416
  };
  Kind kind = Kind::whole;
  uint64_t first = 0;
  uint64_t length = 0;

  bool operator==(const ByteRange&) const = default;
};

/// Reads the header's value ("bytes=0-99", "bytes=100-", "bytes=-100"; empty for none) for a file of `file_length`
/// bytes.
ByteRange parse_range(std::string_view header, uint64_t file_length);

}  // namespace lightwell
