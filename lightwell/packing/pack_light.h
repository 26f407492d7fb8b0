// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/light/light_field.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// A light grid as a pack states it.
struct PackGrid {
  const LightGrid* grid = nullptr;
  GridContents contains{};
  float estimated_error = 0;  ///< share of its root mean square
  int priority = 0;           ///< where grids of the same contents overlap, the one of greater priority is looked up
  uint64_t seed = 1;          ///< of the order in which its nodes are streamed
};

/// The light of a scene as a pack states it.
struct PackLight {
  std::vector<PackGrid> grids;
  std::vector<ClientLamp> lamps;  ///< of the client, the strongest first
  float exposure = 0;             ///< EV
};

}  // namespace lightwell
