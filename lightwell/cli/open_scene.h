// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/cli/arguments.h"
#include "lightwell/light/light_field.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// The scene that the options name, under their environment; a pack's at a level.
Result<Scene> open_scene(const SceneOptions& options, Report& report, const MeshLevel& level = {});

/// The camera of a scene by its name or number; an empty choice is the first one, or an overview where there is none.
Result<Camera> choose_camera(const TraceScene& surfaces, const std::string& choice);

/// The baked light of a pack at a level.
Result<LightField> open_light(const std::string& path, const LightLevel& level);

}  // namespace lightwell
