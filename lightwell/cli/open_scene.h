// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/cli/arguments.h"
#include "lightwell/packing/opened_pack.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// A scene, and the pack that it is from; none when it is from another file or built in.
struct OpenedScene {
  Scene scene;
  std::optional<OpenedPack> pack;
};

/// The scene that the options name, under their environment; a pack's at a level.
Result<OpenedScene> open_scene(const SceneOptions& options, Report& report, const MeshLevel& level = {});

/// The camera of a scene by its name or number; an empty choice is the first one, or an overview where there is none.
Result<Camera> choose_camera(const TraceScene& surfaces, const std::string& choice);

}  // namespace lightwell
