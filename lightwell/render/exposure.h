// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/render/integrator.h"

namespace lightwell {

/// The exposure (EV) that shows a scene well from a camera: the geometric mean of what surfaces reflect in a small
/// picture becomes a middle grey of 0.18, but 95 % of them stay below white. 0 when all is black. `grid` and
/// `contained` as in RenderOptions.
float choose_exposure(const TraceScene& scene, const Camera& camera, const LightGrid& grid,
                      std::span<const uint8_t> contained);

}  // namespace lightwell
