// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/polygon.h"

namespace lightwell {
namespace {

using Point = Vec<double, 2>;

constexpr size_t most_corners_clipped = 256;

/// Newell's normal: exact for plane polygons, the mean for others.
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

/// True when the corner `at` of the polygon of the corners `left` can be cut off.
bool is_ear(const std::vector<Point>& points, const std::vector<uint32_t>& left, size_t at) {
  const size_t n = left.size();
  const Point& a = points[left[(at + n - 1) % n]];
  const Point& b = points[left[at]];
  const Point& c = points[left[(at + 1) % n]];
  if (turn(a, b, c) <= 0) return false;
  for (const uint32_t other : left) {
    if (is_inside(points[other], a, b, c)) return false;
  }
  return true;
}

/// Clips ears until a triangle is left. A polygon that crosses itself may have none; then any corner is cut off.
void clip_ears(const std::vector<Point>& points, std::vector<Face>& triangles) {
  std::vector<uint32_t> left(points.size());
  for (uint32_t i = 0; i < left.size(); i++) left[i] = i;
  while (left.size() > 3) {
    size_t ear = 0;
    while (ear < left.size() && !is_ear(points, left, ear)) ear++;
    ear %= left.size();
    const size_t n = left.size();
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<ptrdiff_t>(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
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
