// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/transform.h"

namespace lightwell {

Transform Transform::rotation(const Vec<double, 4>& q) {
  const double a = q[0], b = q[1], c = q[2], w = q[3];
  return {{{1 - 2 * (b * b + c * c), 2 * (a * b + c * w), 2 * (a * c - b * w)}},
          {{2 * (a * b - c * w), 1 - 2 * (a * a + c * c), 2 * (b * c + a * w)}},
          {{2 * (a * c + b * w), 2 * (b * c - a * w), 1 - 2 * (a * a + b * b)}},
          {}};
}

Vec3f Transform::normal(const Vec3f& n) const {
  const Vec3d m = n.cast<double>();
  Vec3d mapped = cross(y, z) * m[0] + cross(z, x) * m[1] + cross(x, y) * m[2];
  if (determinant() < 0) mapped = -mapped;
  return normalized(mapped).cast<float>();
}

Transform Transform::inverse() const {
  const double d = determinant();
  const Vec3d a = cross(y, z) / d, b = cross(z, x) / d, c = cross(x, y) / d;  // the rows of the inverse
  Transform inverse{{{a[0], b[0], c[0]}}, {{a[1], b[1], c[1]}}, {{a[2], b[2], c[2]}}, {}};
  inverse.t = -inverse.vector(t);
  return inverse;
}

}  // namespace lightwell
