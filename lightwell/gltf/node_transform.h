// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/transform.h"
#include "lightwell/gltf/json.h"

namespace lightwell {

/// The map that scales, then rotates by a quaternion (x, y, z, w) of any length, then translates; a quaternion of zero
/// rotates nothing.
Transform scaled_rotation(const Vec3d& scale, const Vec<double, 4>& rotation, const Vec3d& translation);

/// A node's own transform: its matrix, else its scale, rotation and translation (glTF 2.0, section 3.5.3).
Transform local_transform(const Json& node);

}  // namespace lightwell
