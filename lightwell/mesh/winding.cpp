// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/winding.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "lightwell/mesh/connected_faces.h"

namespace lightwell {
namespace {

/// An edge of a face between welded vertices a < b.
struct Edge {
  uint32_t a = 0, b = 0;
  uint32_t face = 0;
  bool forwards = true;  ///< the face runs from a to b

  bool same_place(const Edge& other) const { return a == other.a && b == other.b; }
};

/// A face beside another one, across an edge.
struct Neighbour {
  uint32_t face = 0;
  bool against = false;  ///< it is wound the other way
};

std::vector<Edge> edges_of(const Mesh& mesh) {
  const std::vector<uint32_t> welded = welded_vertices(mesh.positions);
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.faces.size());
  for (uint32_t face = 0; face < mesh.faces.size(); face++)
    for (size_t corner = 0; corner < 3; corner++) {
      const uint32_t from = welded[mesh.faces[face][corner]], to = welded[mesh.faces[face][(corner + 1) % 3]];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), face, from < to});
    }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& x, const Edge& y) { return std::tie(x.a, x.b, x.face) < std::tie(y.a, y.b, y.face); });
  return edges;
}

/// The neighbours of all faces; false when all are wound alike.
bool find_neighbours(const std::vector<Edge>& edges, std::vector<std::vector<Neighbour>>& neighbours) {
  bool mixed = false;
  for (size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end].same_place(edges[first])) end++;
    if (end - first != 2) continue;
    const Edge &x = edges[first], &y = edges[first + 1];
    const bool against = x.forwards == y.forwards;
    mixed = mixed || against;
    neighbours[x.face].push_back({y.face, against});
    neighbours[y.face].push_back({x.face, against});
  }
  return mixed;
}

double area(const Mesh& mesh, const Face& face) {
  const auto corner = [&](size_t i) { return mesh.positions[face[i]].cast<double>(); };
  return length(cross(corner(1) - corner(0), corner(2) - corner(0)));
}

}  // namespace

std::vector<uint8_t> wound_against_the_rest(const Mesh& mesh) {
  std::vector<uint8_t> against(mesh.faces.size());
  std::vector<std::vector<Neighbour>> neighbours(mesh.faces.size());
  if (!find_neighbours(edges_of(mesh), neighbours)) return against;
  std::vector<uint8_t> reached(mesh.faces.size());
  for (uint32_t start = 0; start < mesh.faces.size(); start++) {
    if (reached[start]) continue;
    std::vector<uint32_t> surface{start};
    reached[start] = 1;
    std::array<double, 2> areas{};
    bool orientable = true;
    for (size_t i = 0; i < surface.size(); i++) {
      const uint32_t face = surface[i];
      areas[against[face]] += area(mesh, mesh.faces[face]);
      for (const Neighbour& beside : neighbours[face]) {
        const uint8_t side = against[face] ^ static_cast<uint8_t>(beside.against);
        if (reached[beside.face]) {
          orientable = orientable && against[beside.face] == side;
          continue;
        }
        reached[beside.face] = 1;
        against[beside.face] = side;
        surface.push_back(beside.face);
      }
    }
    for (const uint32_t face : surface)
      if (!orientable)
        against[face] = 0;
      else if (areas[1] > areas[0])
        against[face] ^= 1;
  }
  return against;
}

}  // namespace lightwell
