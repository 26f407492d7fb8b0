// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lightwell/light/light_field.h"
#include "lightwell/scene/client_lamp.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// The luminaires whose direct light is in the grids of a pack: all but the `lamps` that the client lights, and the
/// environment only where the grids contain it. `world` is that of the pack's own scene at any level.
LuminaireSet contained_luminaires(std::span<const ClientLamp> lamps, const GridContents& contents, const World& world);

}  // namespace lightwell
