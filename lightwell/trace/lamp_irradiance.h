// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/client_lamp.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// The irradiance of a surface at `position` with a unit normal by a lamp that nothing hides but the surface's own
/// horizon, W/m2. In closed form: of rectangles, and of discs as of polygons of as large an area,
/// Lambert's polygon formula (Photometria, 1760), clipped; of spheres the
/// one of S. Lagarde and C. de Rousiers (Moving Frostbite to Physically Based Rendering, 2014, section 4.7.2); of
/// lamps without extent as arrive_punctual(). The same as the page's (shaders/direct_light.glsl).
Vec3f unshadowed_irradiance(const ClientLamp& lamp, const Vec3f& position, const Vec3f& normal);

/// A lamp without extent as the scene's own; the lamp must be a point, a spot or a sun.
Lamp punctual_lamp(const ClientLamp& lamp);

}  // namespace lightwell
