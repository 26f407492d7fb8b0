// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/light_bake.h"
#include "lightwell/bake/unpack.h"
#include "lightwell/cli/command.h"

namespace lightwell {

/// --grid and --photons of the commands that bake a light grid; nodes outside 2 to 256 are bad usage.
void add_grid_options(CLI::App& command, LightBakeOptions& options);

/// The luminaires whose direct light the grid of `path` holds, one flag each: of a pack as it was baked; of a scene,
/// where figures are compared with other programs', the environment only, if that.
Result<std::vector<uint8_t>> contained_in_grid(const std::string& path, const TraceScene& scene,
                                               bool environment = true);

/// Fails when the scene of the pack `path` was given an environment that its grid lacks: bounced light would be
/// missing.
Result<void> check_environment(const std::string& path, const Scene& scene);

/// The light grid that `path` stands for: a pack's own at a level, or one baked from the scene with these options.
Result<LightGrid> light_of(const std::string& path, const TraceScene& scene, const LightBakeOptions& options,
                           Progress& progress, const LightLevel& level = {});

}  // namespace lightwell
