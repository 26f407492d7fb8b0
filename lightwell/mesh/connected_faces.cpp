// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/connected_faces.h"

#include <algorithm>
#include <numeric>

namespace lightwell {
namespace {

/// The piece that a vertex belongs to (union-find with path halving).
uint32_t root(std::vector<uint32_t>& parent, uint32_t vertex) {
  while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
  return vertex;
}

}  // namespace

std::vector<uint32_t> welded_vertices(const std::vector<Vec3f>& positions) {
  std::vector<uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return positions[a] < positions[b]; });
  std::vector<uint32_t> first(positions.size());
  for (size_t i = 0; i < order.size(); i++) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::vector<uint32_t> connected_faces(const Mesh& mesh) {
  std::vector<uint32_t> parent = welded_vertices(mesh.positions);
  for (const Face& face : mesh.faces) {
    const uint32_t a = root(parent, face[0]);
    parent[root(parent, face[1])] = a;
    parent[root(parent, face[2])] = root(parent, a);
  }
  constexpr uint32_t none = ~0u;
  std::vector<uint32_t> number(mesh.positions.size(), none), pieces;
  uint32_t next = 0;
  for (const Face& face : mesh.faces) {
    uint32_t& piece = number[root(parent, face[0])];
    if (piece == none) piece = next++;
    pieces.push_back(piece);
  }
  return pieces;
}

std::vector<uint32_t> joined_vertices(const Mesh& mesh) {
  std::vector<uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const Face& face : mesh.faces)
    for (const uint32_t corner : {face[1], face[2]}) {
      const auto [least, other] = std::minmax({root(parent, face[0]), root(parent, corner)});
      parent[other] = least;
    }
  for (uint32_t v = 0; v < parent.size(); v++) parent[v] = root(parent, v);
  return parent;
}

}  // namespace lightwell
