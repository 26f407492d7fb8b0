// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "lightwell/client/client.h"
#include "lightwell/transport/transport.h"

namespace lightwell {

/// The course of a fetch.
struct FetchOutcome {
  struct Moment {
    double seconds = 0;  ///< of the transport's clock
    uint64_t bytes = 0;  ///< of the file
    uint64_t faces = 0;
    uint64_t nodes = 0;
  };
  uint64_t bytes = 0;
  uint64_t requests = 0;
  double seconds = 0;
  Moment first_picture;          ///< when the opening was handed over, with all coarse meshes and first light
  std::vector<Moment> timeline;  ///< whenever something had been decoded, at most about 100 a second
};

/// What may end a fetch early: a client by itself tries again for ever.
struct FetchGuard {
  /// Asked twice a second or more; true ends the fetch with ErrorKind::cancelled.
  std::function<bool()> cancelled = {};
  /// Called with the reason when the server gives nothing, once until it gives again.
  std::function<void(const std::string&)> outage = {};
  /// After so many seconds without a byte the fetch ends with ErrorKind::io.
  double patience = std::numeric_limits<double>::infinity();
};

/// Runs a client to its end over a transport, in the calling thread; `apply` gets every update. Fails when the client
/// does.
Result<FetchOutcome> fetch(Client& client, Transport& transport, const std::function<void(const Update&)>& apply,
                           const FetchGuard& guard = {});

}  // namespace lightwell
