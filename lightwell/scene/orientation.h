// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/base/transform.h"

namespace lightwell {

/// A direction along an axis of a file: x, y or z, forwards or backwards.
struct AxisDirection {
  int axis = 0;
  bool backwards = false;

  Vec3d vector() const;
  bool operator==(const AxisDirection&) const = default;
};

/// How a file's coordinates are turned and scaled to those of glTF: metres, y up, the front towards +z.
struct Orientation {
  /// Degrees about the file's x axis, then y, then z, before anything else: of scans that stand askew.
  Vec3d rotate{};
  AxisDirection up{.axis = 1};
  /// Where the front faces, across `up`; without one +z of files with y up, else -y, as Blender has it.
  std::optional<AxisDirection> front;
  float unit = 1;  ///< length of the file's unit in metres

  /// Whether a file keeps its coordinates.
  bool none() const { return *this == Orientation(); }
  /// Whether the front is not where up or down is.
  bool possible() const { return !front || front->axis != up.axis; }
  /// The map from the file's coordinates, which must be possible().
  Transform transform() const;

  bool operator==(const Orientation&) const = default;
};

}  // namespace lightwell
