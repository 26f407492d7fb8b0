// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// A photon as it leaves its source.
struct Emission {
  Ray ray;       ///< its `far` is where a lamp's range stops the photon
  Vec3f flux{};  ///< W; its mean over many emissions is the power of the sources
  int luminaire = 0;
};

/// Light that may arrive at a point straight from a source; radiance and sampling density are separate (Pharr, Jakob
/// and Humphreys, Physically Based Rendering, 4th edition, section 12.1).
struct Arrival {
  Vec3f direction{};     ///< unit, towards the source
  float distance = 0;    ///< to the source; infinite for suns and the environment
  Vec3f radiance{};      ///< W/m2/sr; without extent: irradiance facing the source, W/m2; 0: no light
  float density = 0;     ///< of the sample, 1/sr; of a source without extent: its probability
  float clearance = 0;   ///< so near to the source nothing hides it, metres
  bool extended = true;  ///< false: a source without extent, which BSDF samples cannot hit
  int luminaire = 0;
};

/// The share of each colour of the source's light that reaches a point of a surface, of unit normal `normal`: 0 when
/// another one stands between.
Vec3f visibility(const TraceScene& surfaces, const Vec3f& position, const Vec3f& normal, const Arrival& arrival,
                 Random& random);

}  // namespace lightwell
