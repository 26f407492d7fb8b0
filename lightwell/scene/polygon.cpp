// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/polygon.h"

namespace lightwell {
namespace {

using Point = Vec<double, 2>;

constexpr size_t most_corners_clipped = 256;

/// Newell's normal: exact for planar polygons, the mean for others.
Vec3d polygon_normal(std::span<const Vec3f> points) {
  Vec3d sum{};
  const Vec3d origin = points[0].cast<double>();
  for (size_t i = 1; i + 1 < points.size(); i++)
    sum += cross(points[i].cast<double>() - origin, points[i + 1].cast<double>() - origin);
  return sum;
}

/// The points seen along the axis that the normal is nearest to, so that the polygon turns counter-clockwise.
std::vector<Point> flattened(std::span<const Vec3f> points) {
  const Vec3d normal = polygon_normal(points);
  int axis = 0;
  for (int a = 1; a < 3; a++) {
    if (std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
  }
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Point> flat;
  for (const Vec3f& p : points) flat.push_back({{p[u], p[v]}});
  return flat;
}

/// Twice the signed area of a triangle: positive when it turns counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool is_convex(const std::vector<Point>& points) {
  const size_t n = points.size();
  for (size_t i = 0; i < n; i++) {
    if (turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0) return false;
  }
  return true;
}

bool is_inside(const Point& p, const Point& a, const Point& b, const Point& c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0 && p != a && p != b && p != c;
}

/// What is left of a polygon while its ears are cut off: its corners in a ring.
class Ring {
 public:
  explicit Ring(const std::vector<Point>& points) : points_(points) {
    const auto n = static_cast<uint32_t>(points.size());
    for (uint32_t i = 0; i < n; i++) {
      before_.push_back((i + n - 1) % n);
      after_.push_back((i + 1) % n);
    }
    for (uint32_t i = 0; i < n; i++) ears_.push_back(is_ear(i));
  }

  uint32_t after(uint32_t corner) const { return after_[corner]; }
  /// True when a corner can be cut off. Cutting one off changes that of its neighbours only.
  bool ear(uint32_t corner) const { return ears_[corner]; }
  Face triangle(uint32_t corner) const { return {before_[corner], corner, after_[corner]}; }

  void cut(uint32_t corner) {
    const uint32_t before = before_[corner], after = after_[corner];
    after_[before] = after;
    before_[after] = before;
    ears_[before] = is_ear(before);
    ears_[after] = is_ear(after);
  }

 private:
  bool is_ear(uint32_t corner) const {
    const Point &a = points_[before_[corner]], &b = points_[corner], &c = points_[after_[corner]];
    if (turn(a, b, c) <= 0) return false;
    for (uint32_t other = after_[corner]; other != corner; other = after_[other])
      if (is_inside(points_[other], a, b, c)) return false;
    return true;
  }

  const std::vector<Point>& points_;
  std::vector<uint32_t> before_, after_;
  std::vector<bool> ears_;
};

/// Clips ears until a triangle is left. A polygon that crosses itself may have none; then any corner is cut off.
void clip_ears(const std::vector<Point>& points, std::vector<Face>& triangles) {
  Ring ring(points);
  uint32_t corner = 0;
  for (size_t left = points.size(); left > 3; left--) {
    for (size_t tried = 0; tried < left && !ring.ear(corner); tried++) corner = ring.after(corner);
    triangles.push_back(ring.triangle(corner));
    ring.cut(corner);
    corner = ring.after(corner);
  }
  triangles.push_back(ring.triangle(corner));
}

}  // namespace

void triangulate(std::span<const Vec3f> points, std::vector<Face>& triangles) {
  const size_t n = points.size();
  if (n > 3 && n <= most_corners_clipped) {
    const std::vector<Point> flat = flattened(points);
    if (!is_convex(flat)) return clip_ears(flat, triangles);
  }
  for (uint32_t i = 1; i + 1 < n; i++) triangles.push_back({0, i, i + 1});
}

}  // namespace lightwell
