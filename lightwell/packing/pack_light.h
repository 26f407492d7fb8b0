// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/light/light_field.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// A light grid to be packed.
struct PackGrid {
  const LightGrid* grid = nullptr;
  GridContents contains{};
  float estimated_error = 0;  ///< RMS error as a fraction of the grid's RMS
  int priority = 0;           ///< where grids of the same contents overlap, the highest priority is looked up
  uint64_t seed = 1;          ///< of the order in which its nodes are streamed
};

/// The light of a scene to be packed.
struct PackLight {
  std::vector<PackGrid> grids;
  std::vector<ClientLamp> lamps;  ///< whose direct light the client computes, strongest first
  float exposure = 0;             ///< EV
};

}  // namespace lightwell
