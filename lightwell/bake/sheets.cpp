// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/sheets.h"

namespace lightwell {
namespace {

/// Of the angle between a sheet's normal and an axis across which it stands.
constexpr float least_cosine = 0.7f;

/// Whether a ray starts in free space.
bool is_free(const TraceScene& scene, const FreeSpace& space, const Ray& ray, Random& random) {
  Hit hit;
  return scene.intersect(ray, random, hit) ? !space.from_inside(hit) : !space.closed();
}

/// Whether a surface is met from free space.
bool is_seen(const TraceScene& scene, const FreeSpace& space, const Ray& ray, Random& random) {
  Hit hit;
  return scene.intersect(ray, random, hit) && !space.from_inside(hit) &&
         std::abs(dot(hit.normal, ray.direction)) > least_cosine;
}

}  // namespace

bool is_sheet(const TraceScene& scene, const FreeSpace& space, const Hit& hit, const Vec3f& direction, Random& random) {
  const float behind = 4 * scene.offset();
  const Ray back{.origin = hit.position + direction * behind, .direction = -direction, .far = 2 * behind};
  return !space.from_inside(hit) && is_seen(scene, space, back, random) &&
         is_free(scene, space, {back.origin, direction}, random);
}

bool is_on_sheet(const TraceScene& scene, const FreeSpace& space, const Vec3f& node, const Vec3f& cell, int axis,
                 Random& random) {
  const float reach = near_sheet * cell[axis];
  const auto from = [&](float side) {
    Ray ray{.far = 2 * reach};
    ray.direction[axis] = -side;
    ray.origin = node - ray.direction * reach;
    return ray;
  };
  const auto both_sides = [&](const auto& test) { return test(from(-1)) && test(from(1)); };
  return both_sides([&](const Ray& ray) { return is_seen(scene, space, ray, random); }) &&
         both_sides([&](const Ray& ray) {
           return is_free(scene, space, {ray.origin, -ray.direction}, random);
         });
}

}  // namespace lightwell
