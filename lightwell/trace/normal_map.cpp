// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/normal_map.h"

namespace lightwell {

Vec3f mapped_normal(const Vec3f& normal, const std::array<Vec3f, 3>& corners, const std::array<Vec2f, 3>& texcoords,
                    const Vec3f& texel, float scale) {
  const Vec3f edge1 = corners[1] - corners[0], edge2 = corners[2] - corners[0];
  const Vec2f uv1 = texcoords[1] - texcoords[0], uv2 = texcoords[2] - texcoords[0];
  const float winding = uv1[0] * uv2[1] - uv2[0] * uv1[1] < 0 ? -1.0f : 1.0f;
  const Vec3f along_u = (edge1 * uv2[1] - edge2 * uv1[1]) * winding;
  const Vec3f against_v = (edge1 * uv2[0] - edge2 * uv1[0]) * winding;
  const Vec3f in_plane = along_u - normal * dot(normal, along_u);
  const float size = length(in_plane);
  if (!(size > 0)) return normal;
  const Vec3f tangent = in_plane / size;
  const Vec3f across = cross(normal, tangent);
  const Vec3f bitangent = dot(across, against_v) < 0 ? -across : across;
  const Vec3f turned =
      tangent * ((2 * texel[0] - 1) * scale) + bitangent * ((2 * texel[1] - 1) * scale) + normal * (2 * texel[2] - 1);
  const float turned_size = length(turned);
  return turned_size > 0 && std::isfinite(turned_size) ? turned / turned_size : normal;
}

}  // namespace lightwell
