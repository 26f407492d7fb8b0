// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/scene.h"

namespace lightwell {

Box3f Scene::bounds() const {
  Box3f box;
  for (const Instance& instance : instances) {
    for (const Vec3f& p : primitives[static_cast<size_t>(instance.primitive)].mesh.positions)
      box.extend(instance.to_scene.point(p));
  }
  return box;
}

const Material& Scene::material_of(const Primitive& primitive) const {
  static const Material gltf_default;
  return primitive.material < 0 ? gltf_default : materials[static_cast<size_t>(primitive.material)];
}

}  // namespace lightwell
