// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// What tells which group a luminaire is in.
enum class GroupedBy {
  nothing,     ///< all are in one, without a name
  extras,      ///< "lightGroup" in the extras of its node, or of the nearest node above that has it
  collection,  ///< the name of the node above
  name         ///< the node's own name, less a number at its end
};

/// The group that each node of a scene's document belongs to by name; empty where nothing says so.
std::vector<std::string> group_names(const Scene& scene, GroupedBy by);

}  // namespace lightwell
