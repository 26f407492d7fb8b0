// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/creased_mesh.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace lightwell {
namespace {

constexpr float cosine_of_crease = 0.766f;
/// Where more triangles meet, comparing all of them with each other would take too long; they stay flat.
constexpr size_t most_compared = 64;

/// Twice the area of a triangle, along its normal.
Vec3f area_of(const std::vector<Vec3f>& corners, size_t triangle) {
  const Vec3f &a = corners[3 * triangle], &b = corners[3 * triangle + 1], &c = corners[3 * triangle + 2];
  return cross(b - a, c - a);
}

}  // namespace

Mesh creased_mesh(const std::vector<Vec3f>& corners, const std::vector<Vec4f>& colors) {
  std::vector<Vec3f> areas;
  for (size_t t = 0; t < corners.size() / 3; t++) areas.push_back(area_of(corners, t));
  const auto has_area = [&](uint32_t corner) { return length(areas[corner / 3]) > 0; };
  // The corners with a direction, those at one position one after another.
  std::vector<uint32_t> order(corners.size() / 3 * 3);
  std::iota(order.begin(), order.end(), 0);
  order.erase(std::remove_if(order.begin(), order.end(), [&](uint32_t corner) { return !has_area(corner); }),
              order.end());
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return corners[a] == corners[b] ? a < b : corners[a] < corners[b]; });

  Mesh mesh;
  std::vector<uint32_t> vertices(corners.size());
  for (size_t begin = 0; begin < order.size();) {
    size_t end = begin;
    while (end < order.size() && corners[order[end]] == corners[order[begin]]) end++;
    const auto here = std::span(order).subspan(begin, end - begin);
    const size_t first = mesh.positions.size();
    for (const uint32_t corner : here) {
      const Vec3f own = normalized(areas[corner / 3]);
      Vec3f sum = here.size() > most_compared ? own : Vec3f{};
      for (size_t i = 0; i < here.size() && here.size() <= most_compared; i++)
        if (dot(normalized(areas[here[i] / 3]), own) >= cosine_of_crease) sum += areas[here[i] / 3];
      const Vec3f normal = normalized(sum);
      size_t vertex = std::max(first, mesh.positions.size() - std::min(mesh.positions.size(), most_compared));
      while (vertex < mesh.positions.size() &&
             (mesh.normals[vertex] != normal || (!colors.empty() && mesh.colors[vertex] != colors[corner / 3])))
        vertex++;
      if (vertex == mesh.positions.size()) {
        mesh.positions.push_back(corners[corner]);
        mesh.normals.push_back(normal);
        if (!colors.empty()) mesh.colors.push_back(colors[corner / 3]);
      }
      vertices[corner] = static_cast<uint32_t>(vertex);
    }
    begin = end;
  }
  for (uint32_t corner = 0; corner + 2 < corners.size(); corner += 3)
    if (has_area(corner)) mesh.faces.push_back({vertices[corner], vertices[corner + 1], vertices[corner + 2]});
  return mesh;
}

}  // namespace lightwell
