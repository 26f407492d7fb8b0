// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// A photon as it leaves its source.
struct Emission {
  Ray ray;       ///< far: where a lamp's range ends it
  Vec3f flux{};  ///< W; its mean over many emissions is the power of what emits
  int luminaire = 0;
};

/// Light that may arrive at a point straight from a source, radiance and density apart (Pharr, Jakob and Humphreys,
/// Physically Based Rendering, 4th edition, section 12.1).
struct Arrival {
  Vec3f direction{};     ///< unit, towards the source
  float distance = 0;    ///< to the source; infinite for suns and the environment
  Vec3f radiance{};      ///< W/m2/sr; of a source without extent the irradiance facing it, W/m2. 0: nothing arrives
  float density = 0;     ///< of the choice, 1/sr; of a source without extent its probability
  bool extended = true;  ///< false: a source without extent, which no other way of sampling finds
  int luminaire = 0;
};

}  // namespace lightwell
