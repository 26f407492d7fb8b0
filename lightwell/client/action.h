// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lightwell {

/// An instruction from a client to its transport.
struct Action {
  enum class Kind : uint8_t {
    ask,    ///< send a request for the bytes first ... last (HTTP: "Range: bytes=first-last" and no other header), or
            ///< for the whole file, without that header, when `last` is `to_the_end`
    cancel  ///< drop the request `id` and report nothing more about it
  };
  static constexpr uint64_t to_the_end = UINT64_MAX;
  Kind kind = Kind::ask;
  uint32_t id = 0;
  uint64_t first = 0;
  uint64_t last = 0;  ///< inclusive
};

/// The status and headers of a response. A header that is absent, or hidden from the transport by CORS, is empty.
struct ResponseHead {
  int status = 0;
  std::string_view content_range;
  std::string_view etag;
};

/// The value of a Content-Range header (RFC 9110, 14.4): "bytes 0-99/1000", "bytes 0-99/*" or "bytes */1000".
struct ContentRange {
  std::optional<uint64_t> first;
  std::optional<uint64_t> last;
  std::optional<uint64_t> total;

  /// nullopt when the text is not such a value.
  static std::optional<ContentRange> parse(std::string_view text);
};

}  // namespace lightwell
