// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_draco.h"

#include <string_view>

#include "lightwell/gltf/draco_mesh.h"
#include "lightwell/scene/finish_mesh.h"
#include "lightwell/scene/scene_builder.h"

namespace lightwell {

bool is_draco(Bytes file) {
  return std::string_view(reinterpret_cast<const char*>(file.data()), file.size()).starts_with("DRACO");
}

Result<Document> draco_document(Bytes file) {
  LW_TRY(mesh, read_draco_file(file));
  drop_unused_vertices(mesh);
  complete_normals(mesh);
  Lambertian material{.name = "surface", .double_sided = true};
  if (!mesh.colors.empty()) material.color = Vec3f::filled(1);
  SceneBuilder scene;
  scene.object("mesh", {{mesh, scene.material(material)}});
  return scene.release();
}

}  // namespace lightwell
