// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/render/integrator.h"

namespace lightwell {

/// Path tracing, the reference: unbiased for all light up to `max_bounces`.
std::unique_ptr<Integrator> make_path_integrator(const World& world, const IntegratorOptions& options);

}  // namespace lightwell
