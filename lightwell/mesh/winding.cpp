// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/winding.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "lightwell/mesh/connected_faces.h"

namespace lightwell {
namespace {

/// Of a mesh's vertices: so many normals have to point the wrong way before all are turned.
constexpr double nearly_all = 0.95;
/// Of a mesh's faces: as many may be wound against their normals by mistake.
constexpr double a_few = 0.05;

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

void turn_faces(Mesh& mesh, const std::vector<uint8_t>& marked) {
  std::vector<uint8_t> turned(mesh.positions.size()), kept(mesh.positions.size());
  for (size_t i = 0; i < mesh.faces.size(); i++) {
    Face& face = mesh.faces[i];
    for (const uint32_t vertex : face) (marked[i] ? turned : kept)[vertex] = 1;
    if (marked[i]) std::swap(face[1], face[2]);
  }
  if (mesh.normals.empty()) return;
  const std::vector<Vec3f> fronts = smooth_normals(mesh);
  for (size_t i = 0; i < fronts.size(); i++)
    if (turned[i] && !kept[i] && dot(mesh.normals[i], fronts[i]) < 0) mesh.normals[i] = -mesh.normals[i];
}

size_t turn_faces_against_normals(Mesh& mesh) {
  if (mesh.normals.empty()) return 0;
  std::vector<size_t> against;
  for (size_t i = 0; i < mesh.faces.size(); i++) {
    const auto& [a, b, c] = mesh.faces[i];
    const Vec3f front = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    const auto opposed = [&](uint32_t corner) { return dot(mesh.normals[corner], front) < 0; };
    if (opposed(a) && opposed(b) && opposed(c)) against.push_back(i);
  }
  if (static_cast<double>(against.size()) > a_few * static_cast<double>(mesh.faces.size())) return 0;
  for (const size_t i : against) std::swap(mesh.faces[i][1], mesh.faces[i][2]);
  return against.size();
}

bool turn_opposed_normals(Mesh& mesh) {
  if (mesh.normals.empty()) return false;
  const std::vector<Vec3f> fronts = smooth_normals(mesh);
  size_t opposed = 0;
  for (size_t i = 0; i < fronts.size(); i++) opposed += dot(mesh.normals[i], fronts[i]) < 0;
  if (static_cast<double>(opposed) < nearly_all * static_cast<double>(fronts.size())) return false;
  for (Vec3f& normal : mesh.normals) normal = -normal;
  return true;
}

}  // namespace lightwell
