// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// The ray through a point of a camera's picture: x to the right and y down, in [0, 1). `aspect` is the picture's width
/// / height; the camera's yfov spans the picture's height whatever its aspect.
Ray camera_ray(const Camera& camera, float aspect, float x, float y);

}  // namespace lightwell
