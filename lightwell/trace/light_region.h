// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/sampling.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// Where photons carry all of the light: a box, and the sphere round it that beams from afar fill.
class LightRegion {
 public:
  /// The box of a scene; with `open_air`, when an environment shines, some of the air around it, so that a grid has
  /// nodes before the outsides of walls.
  LightRegion(const Box3f& bounds, bool open_air);

  const Box3f& box() const { return box_; }
  /// Of the sphere, metres.
  float radius() const { return radius_; }
  /// Of the sphere's cross-section, m2.
  float beam_area() const { return pi * radius_ * radius_; }
  /// A ray that crosses the sphere in a direction, at a uniform place of the beam that fills it.
  Ray beam_ray(const Vec3f& direction, Random& random) const;

 private:
  Box3f box_;
  Vec3f center_{};
  float radius_ = 0;
};

}  // namespace lightwell
