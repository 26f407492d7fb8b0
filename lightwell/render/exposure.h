// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/light/light_field.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// Chooses the exposure (EV) that shows a scene well from a camera. It meters the light that arrives, as a
/// photographer's incident meter does, so that a white object stays white and a dark one dark: a white surface in the
/// geometric mean of that light is shown at one half, unless more than 5 % of the picture would be brighter than the
/// tone curve can resolve. 0 when all is black. `field` is the baked light, which holds the direct light of `held`. The
/// result does not depend on `threads` (0: all processors).
float choose_exposure(const World& world, const Camera& camera, const LightField& field, const LuminaireSet& held,
                      int threads = 0);

}  // namespace lightwell
