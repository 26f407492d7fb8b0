// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "lightwell/base/progress.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// Turns faces that are wound against the rest of their surface (mesh/winding.h), where light shows which are the wrong
/// ones: photons meet the backs of the one kind and the fronts of the other. Only the primitives of instances with
/// met[instance] are looked at. Gives the names of the meshes; empty when nothing was turned. `world` is that of the
/// scene before.
Result<std::set<std::string>> unify_winding(Scene& scene, const World& world, const std::vector<uint8_t>& met,
                                            int threads, Progress& progress);

}  // namespace lightwell
