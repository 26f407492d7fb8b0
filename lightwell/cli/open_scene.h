// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/base/progress.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/packing/opened_pack.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// A scene and the pack that it comes from, if any.
struct OpenedScene {
  Scene scene;
  std::optional<OpenedPack> pack;
};

/// Opens the scene that the options name, a pack at a level; --environment and --sky replace the scene's own.
Result<OpenedScene> open_scene(const SceneOptions& options, Report& report, const MeshLevel& level = {});

/// Makes the scene ready, if it is no pack as world_facing_light() does.
Result<std::unique_ptr<const World>> ready(OpenedScene& opened, int threads, Progress& progress, Report& report);

/// The camera with this name or number; an empty choice is the first one, or an overview where there is none.
Result<Camera> choose_camera(const World& world, const std::string& choice);

}  // namespace lightwell
