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

/// How a pack came in.
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

/// Who watches over a fetch. A client tries again for ever; here is what may end it before.
struct FetchGuard {
  /// Asked twice a second or more; true ends the run with an error.
  std::function<bool()> cancelled = {};
  /// Told why the server gives nothing, once until it gives again.
  std::function<void(const std::string&)> outage = {};
  /// So many seconds without a byte end the run with an error.
  double patience = std::numeric_limits<double>::infinity();
};

/// Runs a client to its end over a transport; `apply` gets every update. The client's failure is an error.
Result<FetchOutcome> fetch(Client& client, Transport& transport, const std::function<void(const Update&)>& apply,
                           const FetchGuard& guard = {});

}  // namespace lightwell
