// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// The lamp of KHR_lights_punctual that hangs on a node; none when it has none or does not shine.
std::optional<Lamp> read_lamp(const Json& document, int node, const Transform& to_scene);

/// The camera of a node; none when it has none, or one without perspective, which is warned of. Scales of the node are
/// taken out, as glTF asks.
std::optional<Camera> read_camera(const Json& document, int node, const Transform& to_scene, Report& report);

/// scene.extras.lightwell.skyRadiance: a radiance that comes from all directions.
Environment read_environment(const Json& scene);

}  // namespace lightwell
