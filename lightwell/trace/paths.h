// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lightwell/trace/lights.h"

namespace lightwell {

/// Where light is received: a surface point seen from a direction.
struct Receiver {
  Vec3f position{};  ///< on the surface, or in free space
  Vec3f normal{};    ///< geometric, on the side that receives
  Vec3f shading_normal{};
  Vec3f out{};  ///< unit, towards who looks
  Bsdf bsdf;

  /// A receiver whose reflected light is the irradiance of `normal`.
  static Receiver irradiance(const Vec3f& position, const Vec3f& normal);
};

struct PathOptions {
  int max_bounces = 128;  ///< between the source and the receiver: 0 is direct light only
  /// One flag a luminaire: its direct light is counted apart, as of those a light grid contains; empty: none.
  std::span<const uint8_t> apart{};
};

/// What a receiver reflects towards who looks, by the way that the light came: straight from its source, straight from
/// a source that is counted apart, or after at least one reflection.
struct ReceivedLight {
  Vec3f direct{};
  Vec3f apart{};
  Vec3f indirect{};
  int rays = 0;  ///< that were traced for it
};

/// One sample of it: a path traced from the receiver, at each vertex one sample of the lights and one of the surface,
/// weighted by the power heuristic (Veach 1995). Unbiased up to max_bounces.
ReceivedLight trace_path(const TraceScene& scene, const Receiver& receiver, const PathOptions& options, Random& random);

}  // namespace lightwell
