// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/trace/world.h"

namespace lightwell {

/// A lamp inside of a solid, from which its light does not come out. A bulb right round a lamp lets its light out and
/// is none.
struct EnclosedLamp {
  std::string lamp;
  size_t primitive = 0;  ///< of the scene: what encloses it
  float reach = 0;       ///< the longest way to that, metres
};

std::vector<EnclosedLamp> enclosed_lamps(const World& world);

/// Warns of them by the names of both.
void warn_of_enclosed_lamps(const World& world, Report& report);

}  // namespace lightwell
