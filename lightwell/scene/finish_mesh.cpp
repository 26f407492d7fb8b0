// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/finish_mesh.h"

#include <algorithm>

namespace lightwell {
namespace {

// Shorter normals are taken as missing.
constexpr float shortest_normal = 1e-6f;

/// Keeps the entries whose new index is known, in their order.
template <typename T>
void keep_used(std::vector<T>& values, const std::vector<uint32_t>& new_index) {
  if (values.empty()) return;
  size_t kept = 0;
  for (size_t i = 0; i < new_index.size(); i++) {
    if (new_index[i] != UINT32_MAX) values[kept++] = values[i];
  }
  values.resize(kept);
}

}  // namespace

size_t drop_unused_vertices(Mesh& mesh) {
  std::vector<uint32_t> new_index(mesh.positions.size(), UINT32_MAX);
  for (const Face& face : mesh.faces) {
    for (const uint32_t vertex : face) new_index[vertex] = 0;
  }
  uint32_t used = 0;
  for (uint32_t& index : new_index) {
    if (index == 0) index = used++;
  }
  const size_t dropped = new_index.size() - used;
  if (dropped == 0) return 0;
  for (Face& face : mesh.faces) {
    for (uint32_t& vertex : face) vertex = new_index[vertex];
  }
  keep_used(mesh.positions, new_index);
  keep_used(mesh.normals, new_index);
  for (auto& texcoords : mesh.texcoords) keep_used(texcoords, new_index);
  keep_used(mesh.colors, new_index);
  return dropped;
}

void complete_normals(Mesh& mesh) {
  const auto is_missing = [](const Vec3f& n) { return !(length(n) > shortest_normal); };
  if (mesh.normals.empty()) {
    mesh.normals = smooth_normals(mesh);
    return;
  }
  if (std::any_of(mesh.normals.begin(), mesh.normals.end(), is_missing)) {
    const std::vector<Vec3f> smooth = smooth_normals(mesh);
    for (size_t i = 0; i < smooth.size(); i++) {
      if (is_missing(mesh.normals[i])) mesh.normals[i] = smooth[i];
    }
  }
  for (Vec3f& normal : mesh.normals) normal = normalized(normal);
}

}  // namespace lightwell
