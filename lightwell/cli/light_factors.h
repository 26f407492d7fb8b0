// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/light_groups.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/light/light_field.h"

namespace lightwell {

/// By how much the light of a group is multiplied, for each colour.
struct GroupFactor {
  std::string group;
  Vec3f factor;
};

/// Adds --light-group NAME=FACTOR.
void add_light_group_option(CLI::App& command, std::vector<GroupFactor>& factors);

/// The groups of a scene's luminaires: those of its pack, or as --groups says.
Result<std::vector<LightGroup>> groups_of(const OpenedScene& opened, const SceneOptions& options, const World& world);

/// The factors of the groups' luminaires. Fails when there is no group of a name.
Result<LuminaireFactors> luminaire_factors(std::span<const GroupFactor> factors, std::span<const LightGroup> groups);

/// The same light with each group's multiplied by its factor.
LightField dimmed(const LightField& field, std::span<const GroupFactor> factors);

}  // namespace lightwell
