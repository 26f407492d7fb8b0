// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// Point `index` of a progressive sequence in the unit square, any beginning of which covers the square evenly: the
/// first two dimensions of Sobol's (Distribution of Points in a Cube, USSR Computational Mathematics 7, 1967), moved by
/// a digital shift so that the first 4, 16, 64 or 256 points have their mean near the middle. The same as the page's
/// (web/src/three/direct/lamp_points.ts).
Vec2f progressive_point(uint32_t index);

/// A point of a lamp's surface.
struct LampPoint {
  Vec3f position{};  ///< scene space
  Vec3f normal{};    ///< unit
};

/// Point `index` of a rectangle, disc or sphere, in the order of progressive_point(): evenly by area.
LampPoint lamp_point(const ClientLamp& lamp, uint32_t index);

}  // namespace lightwell
