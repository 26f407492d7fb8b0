// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// The inside of a mesh around a place.
struct Enclosure {
  uint32_t instance = 0;  ///< that most ways out meet
  float reach = 0;        ///< the longest way to it, metres
};

/// What encloses a place, if rays in nearly all directions first meet backs of surfaces: the inside of a solid. From
/// within a room they meet fronts.
std::optional<Enclosure> enclosure_of(const TraceScene& scene, const Vec3f& place);

/// How far from a lamp without extent nothing shadows it: as far as a bulb reaches, which is a mesh right round it that
/// is small beside the scene's focus. 0 where there is none.
float bulb_radius(const TraceScene& scene, const Lamp& lamp);

}  // namespace lightwell
