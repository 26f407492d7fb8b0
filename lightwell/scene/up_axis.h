// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"

namespace lightwell {

/// Whether a scene looks as if its z axis pointed up, not y: by its cameras, else by being lower than deep with lamps
/// that shine along -z, with a floor under walls at the lower end of z, or with a terrain's form. Closed rooms without
/// a lamp and single objects say nothing.
bool seems_z_up(const Scene& scene);

}  // namespace lightwell
