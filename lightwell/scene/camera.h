// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"

namespace lightwell {

/// The placement of a camera at `eye` that looks towards `target`, y up; not straight up or down.
Transform looking_at(const Vec3d& eye, const Vec3d& target);

/// Adds a camera, whose place is counted from `origin`, to the shown scene of a document, as a node of its own. Viewers
/// cut off what is nearer than `near` metres.
void add_camera(Document& document, const Camera& camera, float near, const Vec3d& origin = {});

}  // namespace lightwell
