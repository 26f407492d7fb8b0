// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/orientation.h"

#include <array>
#include <cmath>
#include <numbers>

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

/// A turn about an axis, anticlockwise seen from where it points to. Quarters are exact.
Transform turn(int axis, double degrees) {
  double cosine = std::cos(degrees * std::numbers::pi / 180), sine = std::sin(degrees * std::numbers::pi / 180);
  if (std::remainder(degrees, 90) == 0) {
    cosine = std::round(cosine);
    sine = std::round(sine);
  }
  Transform turned;
  std::array<Vec3d*, 3> images{&turned.x, &turned.y, &turned.z};
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  *images[static_cast<size_t>(next)] = {};
  *images[static_cast<size_t>(last)] = {};
  (*images[static_cast<size_t>(next)])[next] = cosine;
  (*images[static_cast<size_t>(next)])[last] = sine;
  (*images[static_cast<size_t>(last)])[next] = -sine;
  (*images[static_cast<size_t>(last)])[last] = cosine;
  return turned;
}

}  // namespace

Vec3d AxisDirection::vector() const {
  Vec3d v{};
  v[axis] = backwards ? -1 : 1;
  return v;
}

Transform Orientation::transform() const {
  LW_ASSERT(!front || front->axis != up.axis);
  const AxisDirection usual = up.axis == 1 ? AxisDirection{.axis = 2} : AxisDirection{.axis = 1, .backwards = true};
  const Vec3d above = up.vector(), ahead = front.value_or(usual).vector(), right = cross(above, ahead);
  // Its rows are where the file has right, up and front.
  const double s = static_cast<double>(unit);
  Transform axes;
  axes.x = Vec3d{{right[0], above[0], ahead[0]}} * s;
  axes.y = Vec3d{{right[1], above[1], ahead[1]}} * s;
  axes.z = Vec3d{{right[2], above[2], ahead[2]}} * s;
  return axes * turn(2, rotate[2]) * turn(1, rotate[1]) * turn(0, rotate[0]);
}

}  // namespace lightwell
