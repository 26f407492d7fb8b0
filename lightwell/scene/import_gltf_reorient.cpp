// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_gltf.h"

namespace lightwell {

void reorient(Document& document, const Orientation& orientation) {
  Json& json = document.json;
  const size_t shown = static_cast<size_t>(std::max(0, index_of(json, "scene")));
  if (orientation.none() || element(member(json, "scenes"), shown).is_null()) return;
  Json scene = std::move(json["scenes"][shown]);
  if (member(scene, "nodes").empty()) scene["nodes"] = Json::array();

  const Transform to = orientation.transform();
  Json matrix = Json::array();
  for (const Vec3d& column : {to.x, to.y, to.z})
    for (const double value : {column[0], column[1], column[2], 0.0}) matrix.push_back(value);
  for (const int value : {0, 0, 0, 1}) matrix.push_back(value);
  Json root = {{"name", "axes and unit"}, {"matrix", std::move(matrix)}};
  if (!scene["nodes"].empty()) root["children"] = std::move(scene["nodes"]);
  json["nodes"].push_back(std::move(root));
  scene["nodes"] = {json["nodes"].size() - 1};
  // Other scenes might share the roots, which have a parent now.
  json["scenes"] = Json::array({std::move(scene)});
  json["scene"] = 0;
}

}  // namespace lightwell
