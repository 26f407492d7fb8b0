// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/unpack.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// True when the file is a pack; false also when it cannot be read.
bool is_pack(const std::string& path);

/// The scene of a file, a pack (at a level) or a built-in scene, under `environment` unless that is empty: "R,G,B" or
/// the name of a Radiance .hdr file.
Result<Scene> open_scene(const std::string& path, const ImportOptions& options, const std::string& environment,
                         Report& report, const MeshLevel& level = {});

/// The camera of a scene by its name or number; an empty choice is the first one, or an overview where there is none.
Result<Camera> choose_camera(const Scene& scene, const std::string& choice);

/// The light grid of a pack at a level.
Result<LightGrid> open_light(const std::string& path, const LightLevel& level);

}  // namespace lightwell
