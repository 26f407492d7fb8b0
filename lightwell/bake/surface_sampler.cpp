// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/surface_sampler.h"

#include <algorithm>

namespace lightwell {
namespace {

/// Of the box's diagonal: how far off the surface the points lie.
constexpr float off_surface = 2e-4f;

/// The corners of what lies in a box of a triangle (Sutherland and Hodgman, Reentrant polygon clipping, CACM 1974).
std::vector<Vec3f> part_within(const std::array<Vec3f, 3>& triangle, const Box3f& box) {
  std::vector<Vec3f> corners(triangle.begin(), triangle.end());
  for (int side = 0; side < 6 && !corners.empty(); side++) {
    const int axis = side / 2;
    // How far inside of the side a corner lies.
    const auto depth = [&](const Vec3f& p) { return side % 2 == 0 ? p[axis] - box.lo[axis] : box.hi[axis] - p[axis]; };
    std::vector<Vec3f> kept;
    for (size_t i = 0; i < corners.size(); i++) {
      const Vec3f &from = corners[i], &to = corners[(i + 1) % corners.size()];
      const float before = depth(from), after = depth(to);
      if (before >= 0) kept.push_back(from);
      if ((before < 0) != (after < 0)) kept.push_back(from + (to - from) * (before / (before - after)));
    }
    corners = std::move(kept);
  }
  return corners;
}

}  // namespace

SurfaceSampler::SurfaceSampler(const TraceScene& scene, const Box3f& box) : scene_(scene), box_(box) {
  std::vector<float> areas;
  for (uint32_t i = 0; i < scene.scene().instances.size(); i++) {
    first_.push_back(areas.size());
    if (!scene.traced(i)) continue;
    for (uint32_t face = 0; face < scene.mesh(i).faces.size(); face++) {
      float area = 0;
      for (const auto& [a, b, c] : within(scene.corners(i, face))) area += length(cross(b - a, c - a));
      areas.push_back(area);
    }
  }
  chosen_ = Distribution(areas);
}

SurfacePoint SurfaceSampler::sample(Random& random) const {
  const size_t number = chosen_.sample(random);
  const auto after = std::upper_bound(first_.begin(), first_.end(), number);
  const auto instance = static_cast<uint32_t>(after - first_.begin() - 1);
  const auto face = static_cast<uint32_t>(number - first_[instance]);
  const auto corners = scene_.corners(instance, face);
  const Vec2f uv = sample_triangle(random);
  const Vec3f normal = scene_.face_normal(instance, corners);
  std::vector<float> areas;
  const auto triangles = within(corners);
  for (const auto& [a, b, c] : triangles) areas.push_back(length(cross(b - a, c - a)));
  const auto& [a, b, c] = triangles[Distribution(areas).sample(random)];
  const Vec3f point = a + (b - a) * uv[0] + (c - a) * uv[1];
  const Vec3f off = normal * (off_surface * length(box_.size()));
  return {point + off, normal, point - off, instance};
}

std::vector<SurfaceSampler::Triangle> SurfaceSampler::within(const Triangle& face) const {
  Box3f box;
  for (const Vec3f& corner : face) box.extend(corner);
  if (max(box_.lo, box.lo) == box.lo && min(box_.hi, box.hi) == box.hi) return {face};
  const std::vector<Vec3f> part = part_within(face, box_);
  std::vector<Triangle> triangles;
  for (size_t i = 2; i < part.size(); i++) triangles.push_back({part[0], part[i - 1], part[i]});
  return triangles;
}

}  // namespace lightwell
