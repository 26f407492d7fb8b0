// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/camera.h"

namespace lightwell {

Ray camera_ray(const Camera& camera, float aspect, float x, float y) {
  const float half_height = std::tan(camera.yfov / 2);
  const Vec3f through{{(2 * x - 1) * half_height * aspect, (1 - 2 * y) * half_height, -1}};
  return {.origin = camera.to_scene.point(Vec3f{}), .direction = normalized(camera.to_scene.vector(through))};
}

}  // namespace lightwell
