// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// The irradiance of a surface at `position` with a unit normal by a lamp that nothing hides but the surface's own
/// horizon, W/m2: of rectangles Lambert's polygon formula (Photometria, 1760), clipped; of discs the same, as of
/// polygons of 64 corners and their area; of spheres that of S. Lagarde and C. de Rousiers (Moving Frostbite to
/// Physically Based Rendering, 2014, section 4.7.2); of lamps without extent as arrive_punctual(). Within 0.5 % of the
/// page's (shaders/direct_light.glsl).
Vec3f unshadowed_irradiance(const ClientLamp& lamp, const Vec3f& position, const Vec3f& normal);

}  // namespace lightwell
