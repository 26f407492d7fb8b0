// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lightwell {

/// Options of make_pack.
struct PackOptions {
  float position_error = 0;  ///< metres that a vertex may move; 0: 14 bits for the longest side of each mesh
  int threads = 0;           ///< 0: all processors
};

}  // namespace lightwell
