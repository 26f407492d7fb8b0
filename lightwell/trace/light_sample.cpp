// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/light_sample.h"

namespace lightwell {

Vec3f visibility(const TraceScene& surfaces, const Vec3f& position, const Vec3f& normal, const Arrival& arrival,
                 Random& random) {
  Ray ray{.origin = surfaces.leave(position, normal), .direction = arrival.direction};
  if (std::isfinite(arrival.distance)) {
    // The ray ends short of the source, as seen from where it really starts.
    const Vec3f source = position + arrival.direction * arrival.distance;
    const Vec3f way = source - ray.origin;
    const float distance = length(way);
    if (distance == 0) return Vec3f::filled(1);
    ray.direction = way / distance;
    ray.far = distance * (1 - 1e-4f) - arrival.clearance;
    if (ray.far <= 0) return Vec3f::filled(1);
  }
  return surfaces.transmittance(ray, random);
}

}  // namespace lightwell
