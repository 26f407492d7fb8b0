// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lightwell/base/result.h"
#include "lightwell/scene/group_names.h"
#include "lightwell/scene/luminaire_id.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// Luminaires that are switched, dimmed and coloured together. Each group has a grid of its own: light adds up.
struct LightGroup {
  std::string name;
  LuminaireSet luminaires;
};

/// The most groups that a pack holds: each takes a grid.
inline constexpr size_t most_light_groups = 16;

/// The groups of a scene's luminaires, in the luminaires' order. The environment and the sun in its picture are "sky",
/// luminaires of which nothing else is said "others". Fails when there are more than most_light_groups.
Result<std::vector<LightGroup>> group_luminaires(const World& world, GroupedBy by);

/// The group of a luminaire; empty when it is in none.
std::string group_of(const LuminaireId& id, const World& world, std::span<const LightGroup> groups);

}  // namespace lightwell
