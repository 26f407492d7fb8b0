// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// True when the light grid of a pack, by its JSON, holds the light of an environment.
bool contains_environment(const Json& pack);

/// Which luminaires' direct light the grid of a pack holds, by its JSON: those of the `world` of the pack's
/// own scene at any level. All but the lamps of LIGHTWELL_lamps, and the environment where the pack says so. A lamp is
/// the luminaire of its node and kind that stands nearest to it.
LuminaireSet contained_luminaires(const Json& pack, const World& world);

}  // namespace lightwell
