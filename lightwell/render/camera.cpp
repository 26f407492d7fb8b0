// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/camera.h"

namespace lightwell {

Ray camera_ray(const Camera& camera, float aspect, float x, float y) {
  const float half_height = std::tan(camera.yfov / 2);
  const Vec3f through{{(2 * x - 1) * half_height * aspect, (1 - 2 * y) * half_height, -1}};
  return {.origin = camera.to_scene.point(Vec3f{}), .direction = normalized(camera.to_scene.vector(through))};
}

Camera overview_camera(const Box3f& bounds) {
  Camera camera;
  camera.name = "overview";
  const double radius = std::max(1e-6, static_cast<double>(length(bounds.size())) / 2);
  const double distance = radius / std::sin(static_cast<double>(camera.yfov) / 2);
  const Vec3d back = normalized(Vec3d{{0, 0.3, 1}});
  const Vec3d right{{1, 0, 0}};
  camera.to_scene = {right, cross(back, right), back, bounds.center().cast<double>() + back * distance};
  return camera;
}

}  // namespace lightwell
