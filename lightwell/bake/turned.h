// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lightwell/base/progress.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// Makes a scene ready whose faces may look the wrong way, as far as light shows it. Photons tell which sides of the
/// surfaces that have one side they reach, and whether they stay there. A piece whose fronts they never meet, but from
/// whose backs they go on to other surfaces, is turned round: the walls of a room whose faces all look outwards. A
/// closed shell that looks outwards and is lit on both sides that way gets two sides. What looks away from an open sky
/// stays as it is: it is a wall without a back. The few faces that are wound against the normals of their corners are
/// turned before, and in the end the normals of vertices point where the faces do. `report`
/// gets a warning that names the meshes. The document of the scene follows. Fails as World::build does, and when
/// `progress` is cancelled.
Result<std::unique_ptr<const World>> world_facing_light(Scene& scene, int threads, Progress& progress, Report& report);

}  // namespace lightwell
