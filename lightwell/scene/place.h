// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/base/vector.h"

namespace lightwell {

/// Where a part of something lies, in the coordinates of its file.
struct Place {
  Vec3d center{};
  double radius = 0;
  double weight = 1;  ///< how much of the whole it is
};

/// The origin to count coordinates from, so that floats tell apart what is there: zero where the file's own origin is
/// near enough, else a point amid the parts (geographical coordinates are millions of metres from theirs). A tenth of
/// the parts, by weight, may lie anywhere. Its coordinates have few digits, so that sums with it are exact.
Vec3d origin_amid(std::vector<Place> places);

/// The same for points; a few thousand of them, evenly chosen, tell.
Vec3d origin_amid(const std::vector<Vec3d>& points);

}  // namespace lightwell
