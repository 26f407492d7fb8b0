// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/light_bake.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/light/light_field.h"
#include "lightwell/packing/unpack.h"

namespace lightwell {

/// The luminaires whose direct light the grids of `scene` hold: of a pack as it was baked; of another scene, where
/// figures are compared with other programs', the environment only, if that.
LuminaireSet contained_in_grids(const OpenedScene& scene, const World& world, bool environment = true);

/// Fails when the scene of a pack was given an environment that its grids lack: bounced light would be missing.
Result<void> check_environment(const OpenedScene& scene);

/// The baked light that a scene stands for: the grids of its pack at a level, or one grid baked as its options say,
/// with the direct light of the `contained` luminaires.
Result<LightField> light_of(const OpenedScene& scene, const SceneOptions& options, const World& world,
                            const LuminaireSet& contained, Progress& progress, const LightLevel& level = {});

}  // namespace lightwell
