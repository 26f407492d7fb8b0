// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/light_region.h"
#include "lightwell/trace/light_sample.h"

namespace lightwell {

/// A lamp without extent as a source of light, after KHR_lights_punctual: points and spots, whose light a cone and a
/// range end, and suns.

/// The lamp's power, W; of a sun what enters the region's sphere. A range does not lessen it.
Vec3f punctual_power(const Lamp& lamp, const LightRegion& region);

/// A photon of the lamp. The range window falls from 1 to 0 with the distance, so it is taken as the chance that a
/// photon gets that far.
Emission emit_punctual(const Lamp& lamp, const LightRegion& region, Random& random);

/// The irradiance of a surface at `point` that faces the lamp, unoccluded; its density is 1.
Arrival arrive_punctual(const Lamp& lamp, const Vec3f& point);

}  // namespace lightwell
