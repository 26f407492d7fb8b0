// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/light_region.h"
#include "lightwell/trace/light_sample.h"

namespace lightwell {

// Lamps without extent as sources of light, after KHR_lights_punctual: points and spots, limited by a cone and a range,
// and suns.

/// The lamp's power, W; for a sun, the power that enters the region's sphere. A range does not reduce it.
Vec3f punctual_power(const Lamp& lamp, const LightRegion& region);

/// Emits a photon. The range window falls from 1 to 0 with distance and serves as the probability that a photon gets
/// that far.
Emission emit_punctual(const Lamp& lamp, const LightRegion& region, Random& random);

/// The unoccluded irradiance of a surface at `point` that faces the lamp; its density is 1.
Arrival arrive_punctual(const Lamp& lamp, const Vec3f& point);

}  // namespace lightwell
