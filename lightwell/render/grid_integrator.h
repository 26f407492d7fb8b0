// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/render/integrator.h"

namespace lightwell {

/// Direct light by path tracing, the rest looked up in the baked light, as the viewer does.
std::unique_ptr<Integrator> make_grid_integrator(const World& world, const IntegratorOptions& options);

/// The radiance that a surface reflects from baked light towards the viewer, W/m2/sr: the Lambertian part of the
/// irradiance and, for metals, the irradiance of the mirrored direction / pi, looked up at the same place, as in the
/// web viewer.
Vec3f reflected_from_field(const LightField& field, const Receiver& receiver);

}  // namespace lightwell
