// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/surface_sampler.h"

#include <algorithm>
#include <cmath>

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
  struct Alike {
    std::shared_ptr<const Distribution> faces;
    double size = 0;  // of the instance that they are of
  };
  const Scene& placed = scene.scene();
  std::vector<Box3f> bounds;
  for (const Primitive& primitive : placed.primitives) bounds.push_back(primitive.mesh.bounds());
  std::vector<Alike> alike(placed.primitives.size());
  for (uint32_t i = 0; i < placed.instances.size(); i++) {
    faces_.emplace_back();
    const auto primitive = static_cast<size_t>(placed.instances[i].primitive);
    if (!scene.traced(i)) {
      instances_.add(0);
    } else if (!is_like_its_primitive(i, bounds[primitive])) {
      faces_.back() = std::make_shared<const Distribution>(areas_of(i));
      instances_.add(faces_.back()->total());
    } else {
      Alike& one = alike[primitive];
      const double size = length(placed.instances[i].to_scene.x);
      if (one.faces == nullptr) one = {std::make_shared<const Distribution>(areas_of(i)), size};
      faces_.back() = one.faces;
      instances_.add(one.faces->total() * (size / one.size) * (size / one.size));
    }
  }
}

Distribution SurfaceSampler::areas_of(uint32_t instance) const {
  const auto faces = static_cast<uint32_t>(scene_.mesh(instance).faces.size());
  Distribution areas;
  areas.reserve(faces);
  for (uint32_t face = 0; face < faces; face++) {
    float area = 0;
    for (const auto& [a, b, c] : within(scene_.corners(instance, face))) area += length(cross(b - a, c - a));
    areas.add(static_cast<double>(area));
  }
  return areas;
}

bool SurfaceSampler::is_like_its_primitive(uint32_t instance, const Box3f& of_primitive) const {
  constexpr double rounding = 1e-6;  // of the squared lengths of the axes
  const Transform& placed = scene_.scene().instances[instance].to_scene;
  const double size = dot(placed.x, placed.x);
  const double uneven = std::max({std::abs(dot(placed.y, placed.y) - size), std::abs(dot(placed.z, placed.z) - size),
                                  std::abs(dot(placed.x, placed.y)), std::abs(dot(placed.y, placed.z)),
                                  std::abs(dot(placed.z, placed.x))});
  if (!(uneven <= rounding * size) || size <= 0) return false;
  for (int corner = 0; corner < 8; corner++) {
    Vec3f at = of_primitive.lo;
    for (int axis = 0; axis < 3; axis++)
      if ((corner >> axis & 1) != 0) at[axis] = of_primitive.hi[axis];
    const Vec3f p = placed.point(at);
    if (max(box_.lo, min(p, box_.hi)) != p) return false;
  }
  return true;
}

SurfacePoint SurfaceSampler::sample(Random& random) const {
  const Distribution::Place place = instances_.at(random.bits() * 0x1p-32);
  const auto instance = static_cast<uint32_t>(place.index);
  const Distribution& faces = *faces_[instance];
  const auto face = static_cast<uint32_t>(faces.at(place.share).index);  // by what is left of the number
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
