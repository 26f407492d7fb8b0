// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/sampling.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// The region in which photons carry all of the light: a box, and the sphere around it, whose cross-section the beams
/// of distant sources fill.
class LightRegion {
 public:
  /// The box of a scene. With `open_air`, for a scene with an environment, it is enlarged by a margin, so that a grid
  /// has nodes in front of outer walls.
  LightRegion(const Box3f& bounds, bool open_air);

  const Box3f& box() const { return box_; }
  /// The sphere's radius, metres.
  float radius() const { return radius_; }
  /// The area of the sphere's cross-section, m2.
  float beam_area() const { return pi * radius_ * radius_; }
  /// A ray through the sphere in a direction, at a uniformly chosen point of its cross-section.
  Ray beam_ray(const Vec3f& direction, Random& random) const;

 private:
  Box3f box_;
  Vec3f center_{};
  float radius_ = 0;
};

}  // namespace lightwell
