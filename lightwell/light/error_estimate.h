// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lightwell {

/// By how much a grid is estimated to err, at test points that had no part in its bake: root mean square, as a share of
/// the mean irradiance of all of them (docs/light.md section 4).
struct ErrorEstimate {
  float surface = 0;  ///< at points of surfaces
  float free = 0;     ///< at points of free space

  bool operator==(const ErrorEstimate&) const = default;
};

}  // namespace lightwell
