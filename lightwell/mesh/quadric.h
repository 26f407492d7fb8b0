// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/vector.h"

namespace lightwell {

/// The weighted sum of squared distances to planes as a function of the offset from the point that owns it (M. Garland
/// and P. Heckbert, "Surface Simplification Using Quadric Error Metrics", SIGGRAPH 1997, section 5). Unlike in the
/// paper, each quadric has its origin at its own point, where it is accurate in single precision.
class Quadric {
 public:
  /// Adds a plane through the owner.
  void add_plane(const Vec3f& unit_normal, float weight) {
    const Vec3f n = unit_normal * weight;
    xx_ += n[0] * unit_normal[0];
    yy_ += n[1] * unit_normal[1];
    zz_ += n[2] * unit_normal[2];
    xy_ += n[0] * unit_normal[1];
    xz_ += n[0] * unit_normal[2];
    yz_ += n[1] * unit_normal[2];
  }

  /// The sum of weighted squared distances from owner + t to the planes.
  float at(const Vec3f& t) const { return std::max(dot(t, times(t) + linear_ * 2.0f) + constant_, 0.0f); }

  /// The sum of the planes' weights.
  float weight() const { return xx_ + yy_ + zz_; }

  /// Adds the quadric of another owner; t is the vector from that one to this.
  void add(const Quadric& other, const Vec3f& t) {
    linear_ += other.linear_ + other.times(t);
    constant_ += other.at(t);
    xx_ += other.xx_;
    yy_ += other.yy_;
    zz_ += other.zz_;
    xy_ += other.xy_;
    xz_ += other.xz_;
    yz_ += other.yz_;
  }

 private:
  Vec3f times(const Vec3f& t) const {
    return {{xx_ * t[0] + xy_ * t[1] + xz_ * t[2], xy_ * t[0] + yy_ * t[1] + yz_ * t[2],
             xz_ * t[0] + yz_ * t[1] + zz_ * t[2]}};
  }

  float xx_ = 0, yy_ = 0, zz_ = 0, xy_ = 0, xz_ = 0, yz_ = 0;
  Vec3f linear_;
  float constant_ = 0;
};

}  // namespace lightwell
