// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/camera.h"

namespace lightwell {

Transform looking_at(const Vec3d& eye, const Vec3d& target) {
  const Vec3d back = normalized(eye - target);
  const Vec3d right = normalized(cross(Vec3d{{0, 1, 0}}, back));
  return {right, cross(back, right), back, eye};
}

void add_camera(Document& document, const Camera& camera, float near, const Vec3d& origin) {
  Json perspective = {{"yfov", camera.yfov}, {"znear", near}};
  if (camera.aspect > 0) perspective["aspectRatio"] = camera.aspect;
  Json json = {{"name", camera.name}, {"type", "perspective"}, {"perspective", std::move(perspective)}};
  if (camera.width > 0 && camera.height > 0) json["extras"] = {{"width", camera.width}, {"height", camera.height}};

  Json matrix = Json::array();
  const auto add_column = [&](const Vec3d& column, int last) {
    for (const double x : column.e) matrix.push_back(x);
    matrix.push_back(last);
  };
  add_column(camera.to_scene.x, 0);
  add_column(camera.to_scene.y, 0);
  add_column(camera.to_scene.z, 0);
  add_column(camera.to_scene.t + origin, 1);

  DocumentBuilder builder(document);
  const int index = builder.add("cameras", std::move(json));
  const int node = builder.add("nodes", {{"name", camera.name}, {"camera", index}, {"matrix", std::move(matrix)}});
  const auto shown = static_cast<size_t>(std::max(0, index_of(document.json, "scene")));
  document.json["scenes"][shown]["nodes"].push_back(node);
}

}  // namespace lightwell
