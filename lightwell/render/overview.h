// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// A camera for a scene that has none. A scene that encloses its space, as a room does, is shown from within: of level
/// views from the points of a lattice, the one whose rays go farthest (geometric mean), where what light reaches
/// straight counts for ten times as far. Any other is shown whole from its front (+z), a little from above. The same
/// scene always gets the same camera.
Camera overview_camera(const World& world);

}  // namespace lightwell
