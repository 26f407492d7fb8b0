// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// The lamp that KHR_lights_punctual attaches to a node; none when there is none, it gives no light, or is of a type
/// that nobody knows, for which `report` gets a warning.
std::optional<Lamp> read_lamp(const Json& document, int node, const Transform& to_scene, Report& report);

/// The camera of a node; none when the node has none, or one without perspective, for which `report` gets a warning.
/// The node's scale is removed, as glTF asks.
std::optional<Camera> read_camera(const Json& document, int node, const Transform& to_scene, Report& report);

}  // namespace lightwell
