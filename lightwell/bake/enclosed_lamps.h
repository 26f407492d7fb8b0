// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/world.h"

namespace lightwell {

/// Warns of lamps that stand inside of a solid, from which their light does not come out, by the names of both. A bulb
/// right round a lamp lets its light out and is nothing to warn of.
void warn_of_enclosed_lamps(const World& world, Report& report);

}  // namespace lightwell
