// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/scene/client_lamp.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// Who lights what: the light of the client's lamps is bounced into the grid only; that of the other luminaires, which
/// the client does not know, goes into the grid from its first flight on. So no light is missing or counted twice.
struct LampPlan {
  std::vector<ClientLamp> client;  ///< the strongest first
  /// The luminaires whose direct light the grid holds as well (EstimatorOptions::contained).
  LuminaireSet contained;
};

/// Splits a scene's luminaires: of those that give light, the `most` strongest that a rectangle, a sphere or a punctual
/// lamp describes are the client's. A piece of emissive surface is a rectangle when it lies in one plane, a sphere when
/// it is closed and about as far from its centre everywhere; one of any other form is the grid's, and so is the
/// environment.
LampPlan plan_lamps(const World& world, size_t most = 16);

}  // namespace lightwell
