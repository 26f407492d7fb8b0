// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/render/integrator.h"

namespace lightwell {

/// The direct light only.
std::unique_ptr<Integrator> make_direct_integrator(const World& world, const IntegratorOptions& options);

}  // namespace lightwell
