// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lightwell/light/grid.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// The exposure (EV) that shows a scene well from a camera. It is metered by the light that arrives, as with a
/// photographer's incident meter, so that a white object stays white and a dark one dark: a white surface in the
/// geometric mean of that light is shown at one half, unless more than 5 % of what is seen would be brighter than the
/// tone curve can tell apart. 0 when all is black. `grid` and `contained` as in RenderOptions.
float choose_exposure(const TraceScene& scene, const Camera& camera, const LightGrid& grid,
                      std::span<const uint8_t> contained);

}  // namespace lightwell
