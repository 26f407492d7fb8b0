// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lightwell/light/light_field.h"
#include "lightwell/scene/client_lamp.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// Which luminaires' direct light the grids of a pack hold: those of the `world` of the pack's own scene at any level.
/// All but the `lamps` that the client lights, and the environment where the grids contain it.
LuminaireSet contained_luminaires(std::span<const ClientLamp> lamps, const GridContents& contents, const World& world);

}  // namespace lightwell
