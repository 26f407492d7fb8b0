// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/vector.h"

namespace lightwell {

/// An affine map p -> x p0 + y p1 + z p2 + t of points (column vectors, as in glTF), in double precision so that deep
/// node hierarchies stay accurate.
struct Transform {
  Vec3d x{{1, 0, 0}}, y{{0, 1, 0}}, z{{0, 0, 1}}, t{};

  static Transform translation(Vec3d by) { return {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, by}; }
  static Transform scaling(Vec3d s) { return {{{s[0], 0, 0}}, {{0, s[1], 0}}, {{0, 0, s[2]}}, {}}; }
  /// The rotation of a unit quaternion (x, y, z, w).
  static Transform rotation(const Vec<double, 4>& q);

  Vec3f point(const Vec3f& p) const { return point(p.cast<double>()).cast<float>(); }
  Vec3d point(const Vec3d& p) const { return vector(p) + t; }
  Vec3f vector(const Vec3f& v) const { return vector(v.cast<double>()).cast<float>(); }
  Vec3d vector(const Vec3d& v) const { return x * v[0] + y * v[1] + z * v[2]; }
  /// The unit normal of a mapped surface whose normal was n. It uses the cofactors, so that it stays perpendicular
  /// under uneven scales; mirroring does not turn it inside out. Zero when the map flattens the surface.
  Vec3f normal(const Vec3f& n) const;
  double determinant() const { return dot(x, cross(y, z)); }
  /// The inverse map. The determinant must not be zero.
  Transform inverse() const;

  /// The map that applies first b, then a.
  friend Transform operator*(const Transform& a, const Transform& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.t)};
  }
};

}  // namespace lightwell
