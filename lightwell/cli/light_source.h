// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/light_bake.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/light/light_field.h"
#include "lightwell/packing/unpack.h"

namespace lightwell {

/// The luminaires whose direct light is in the grids of `scene`: for a pack, those it was baked with; for another
/// scene, whose figures are compared with other programs', only the environment, and that only if `environment` is set.
LuminaireSet contained_in_grids(const OpenedScene& scene, const World& world, bool environment = true);

/// Fails when a pack is given an environment that it was not baked with: its bounced light would be missing.
Result<void> check_environment(const OpenedScene& scene);

/// The grids of a pack at a level.
Result<LightField> light_of_pack(const OpenedPack& pack, const LightLevel& level);

/// Leaves the sky's own light out of a field that has it apart, and out of the luminaires that it holds: for who finds
/// it by rays, which know the shadows that are smaller than the field's cells. Gives what was left out.
LightField leave_sky_to_rays(const World& world, LightField& field, LuminaireSet& held);

/// The baked light of a scene: the grids of its pack at a level or, without a pack, one grid baked with `options`,
/// including the direct light of the `contained` luminaires, for each of the groups.
Result<LightField> light_of(const OpenedScene& scene, const SceneOptions& options, const World& world,
                            const LuminaireSet& contained, std::span<const LightGroup> groups, Progress& progress,
                            const LightLevel& level = {});

}  // namespace lightwell
