// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/light_bake.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/light/light_field.h"
#include "lightwell/packing/unpack.h"

namespace lightwell {

/// The luminaires whose direct light the grid of `path` holds: of a pack as it was baked; of a scene, where figures are
/// compared with other programs', the environment only, if that.
Result<LuminaireSet> contained_in_grid(const std::string& path, const World& world, bool environment = true);

/// Fails when the scene of the pack `path` was given an environment that its grid lacks: bounced light would be
/// missing.
Result<void> check_environment(const std::string& path, const Scene& scene);

/// The baked light that a scene stands for: a pack's own at a level, or one grid baked as its options say, with the
/// direct light of the `contained` luminaires.
Result<LightField> light_of(const SceneOptions& options, const World& world, const LuminaireSet& contained,
                            Progress& progress, const LightLevel& level = {});

}  // namespace lightwell
