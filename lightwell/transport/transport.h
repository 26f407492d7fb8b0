// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/client/action.h"

namespace lightwell {

/// An event in the course of a request.
struct TransportEvent {
  enum class Kind : uint8_t {
    head,    ///< the response begins: status and header fields
    bytes,   ///< a piece of its body
    end,     ///< its body has ended
    failed,  ///< there was no response, or the connection broke
  };
  Kind kind = Kind::failed;
  uint32_t request = 0;
  int status = 0;
  std::string content_range;
  std::string etag;
  std::vector<uint8_t> bytes;
  std::string reason = {};  ///< of a failure, in the system's words: "Connection refused"
};

/// A carrier of a client's requests for the bytes of one file. For one thread at a time.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Seconds since the transport was made.
  virtual double now() = 0;
  /// Sends a request, as Action has it. Its events come out of wait().
  virtual void ask(uint32_t request, uint64_t first, uint64_t last) = 0;
  /// Drops a request: no further event of it comes.
  virtual void cancel(uint32_t request) = 0;
  /// The next event; waits for one until the time `until` at the longest, then gives nothing.
  virtual std::optional<TransportEvent> wait(double until) = 0;
};

/// A transport for a file in memory: every answer is there at once. Its clock advances by waiting only.
std::unique_ptr<Transport> memory_transport(std::vector<uint8_t> file);

/// A transport for "http://host[:port]/path" (HTTP/1.1, connections kept alive, redirections to such URLs followed); an
/// IPv6 address stands in brackets. Errors: another kind of URL (ErrorKind::bad_input), an unknown host (io). That
/// nobody answers is a failed request, which a client tries again.
Result<std::unique_ptr<Transport>> http_transport(const std::string& url);

/// How slow a line is.
struct LineShape {
  double bits_per_second = 0;  ///< shared by all requests; 0: as fast as it goes
  double latency = 0;          ///< seconds from a question to its answer
};

/// Another transport over a slower line: its events come later, its bytes in pieces of at most 4 KB.
std::unique_ptr<Transport> shaped_transport(std::unique_ptr<Transport> inner, const LineShape& shape);

}  // namespace lightwell
