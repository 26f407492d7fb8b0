// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"

namespace lightwell {

/// How hazy the air is: the light that air and haze take, over that which the air alone takes. 2 is a very clear day, 3
/// a clear one, 6 a hazy one.
constexpr float least_turbidity = 1, most_turbidity = 10, usual_turbidity = 3;

/// The picture of the clear sky around a sun (scene/atmosphere.h), without the sun itself, which stays a lamp; below
/// the horizon it shows the ground that both light. The sky is that of a sun which has the lamp's luminance after its
/// way through the air, and is white before it: the lamp's own colour is the lamp's alone. A sun below five degrees is
/// as strong as one of five degrees, since few files dim a sun that sets; below the horizon there is dusk.
Environment physical_sky(const Lamp& sun, float turbidity);

/// The strongest sun of a scene, null where there is none.
const Lamp* strongest_sun(const Scene& scene);

/// Gives a scene the sky of its strongest sun in place of its environment, and notes it in its document, so that a pack
/// keeps it. Fails where there is no sun.
Result<void> light_by_sky(Scene& scene, float turbidity);

}  // namespace lightwell
