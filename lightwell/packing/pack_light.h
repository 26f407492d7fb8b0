// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/light/error_estimate.h"
#include "lightwell/light/lattice_record.h"
#include "lightwell/light/light_field.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// The order in which the nodes of a grid are streamed, each a codec of its own.
enum class LightNodeOrder : uint8_t {
  lattice,  ///< from coarse to fine, then bricks
  slices    ///< random ones from every slice, as in S08; not for grids with bricks
};

/// A light grid to be packed.
struct PackGrid {
  const LightGrid* grid = nullptr;
  GridContents contains{};
  float estimated_error = 0;  ///< root mean square error as a share of the mean irradiance
  ErrorEstimate estimate{};
  int priority = 0;  ///< where grids of the same contents overlap, the highest priority is looked up
  LightNodeOrder order = LightNodeOrder::lattice;
  LightRecord record = LightRecord::moments;  ///< of the lattice order
  uint64_t seed = 1;                          ///< of the order of slices
};

/// The light of a scene to be packed.
struct PackLight {
  std::vector<PackGrid> grids;
  std::vector<ClientLamp> lamps;  ///< whose direct light the client computes, strongest first
  float exposure = 0;             ///< EV
};

}  // namespace lightwell
