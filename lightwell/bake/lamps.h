// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/scene/client_lamp.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// How luminaires are divided between the client and the grid. For the client's lamps the grid holds only the bounced
/// light; for the others, which the client does not know, it also holds the direct light. So no light is missing or
/// counted twice.
struct LampPlan {
  std::vector<ClientLamp> client;  ///< the strongest first
  /// The luminaires whose direct light the grid holds as well (EstimatorOptions::contained).
  LuminaireSet contained;
};

/// Divides a scene's luminaires: the client gets the `most` strongest that emit light and that a rectangle, a disc, a
/// sphere or a punctual lamp describes. A piece of emissive surface that lies in one plane is a disc when it is one or
/// a regular polygon of six or more sides, else a rectangle, several where a texture makes parts of it shine; a sphere
/// when it is closed and about equally far from its centre everywhere. Other shapes and the environment go to the grid.
LampPlan plan_lamps(const World& world, size_t most = 16);

}  // namespace lightwell
