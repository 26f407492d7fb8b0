// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/node_transform.h"

namespace lightwell {

Transform scaled_rotation(const Vec3d& scale, const Vec<double, 4>& rotation, const Vec3d& translation) {
  const Vec<double, 4> q = length(rotation) > 0 ? normalized(rotation) : Vec<double, 4>{{0, 0, 0, 1}};
  return Transform::translation(translation) * Transform::rotation(q) * Transform::scaling(scale);
}

Transform local_transform(const Json& node) {
  if (node.contains("matrix")) {
    const auto m = numbers<16>(node, "matrix", {});
    return {{{m[0], m[1], m[2]}}, {{m[4], m[5], m[6]}}, {{m[8], m[9], m[10]}}, {{m[12], m[13], m[14]}}};
  }
  return scaled_rotation(numbers<3>(node, "scale", Vec3d::filled(1)), numbers<4>(node, "rotation", {{0, 0, 0, 1}}),
                         numbers<3>(node, "translation", {}));
}

}  // namespace lightwell
