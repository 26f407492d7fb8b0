// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/mesh_groups.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "lightwell/mesh/stream.h"
#include "lightwell/packing/mergeable_parts.h"

namespace lightwell {
namespace {

/// What touches and has more vertices is refined by itself: its stream costs little beside them.
constexpr size_t many_vertices = size_t(1) << 16;
/// Of what does not touch; a viewer refines streams in the order in which they matter to its picture.
constexpr size_t most_vertices_of_a_group = size_t(1) << 20;
/// What the lattice that a group shares has over all of it (QuantizeOptions).
constexpr float steps_of_all = 1 << 20;

/// Sets that grow together.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), size_t(0)); }
  size_t of(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(size_t a, size_t b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<size_t> parent_;
};

/// The places of the vertices of some primitives: vertices of equal positions have the same number.
class Places {
 public:
  Places(const Scene& scene, const MeshGroup& primitives) {
    for (const int primitive : primitives) {
      const Mesh& mesh = scene.primitives[static_cast<size_t>(primitive)].mesh;
      meshes_.push_back(&mesh);
      of_.emplace_back(mesh.positions.size(), nowhere);
      for (uint32_t v = 0; v < mesh.positions.size(); v++)
        if (is_finite(mesh.positions[v]))
          sorted_.emplace_back(mesh.positions[v], static_cast<uint32_t>(meshes_.size() - 1), v);
    }
    std::ranges::sort(sorted_);
    uint32_t place = 0;
    for (size_t i = 0; i < sorted_.size(); i++) {
      place += i > 0 && std::get<0>(sorted_[i]) != std::get<0>(sorted_[i - 1]);
      of_[std::get<1>(sorted_[i])][std::get<2>(sorted_[i])] = place;
    }
  }

  /// Joins the primitives that have a vertex at one place, but for those that are apart.
  DisjointSets touching(const std::vector<bool>& apart) const {
    DisjointSets sets(meshes_.size());
    const Vec3f* last = nullptr;
    uint32_t of_last = 0;
    for (const auto& [position, mesh, vertex] : sorted_) {
      if (apart[mesh]) continue;
      if (last && *last == position) sets.join(mesh, of_last);
      last = &position;
      of_last = mesh;
    }
    return sets;
  }

  /// How many faces of each primitive lie where one of an earlier one does, whichever way they are turned.
  std::vector<size_t> repeated() const {
    std::vector<std::pair<Face, uint32_t>> faces;
    for (uint32_t i = 0; i < meshes_.size(); i++)
      for (const Face& face : meshes_[i]->faces) {
        Face places{of_[i][face[0]], of_[i][face[1]], of_[i][face[2]]};
        std::ranges::sort(places);
        faces.emplace_back(places, i);
      }
    std::ranges::sort(faces);
    std::vector<size_t> repeated(meshes_.size());
    for (size_t first = 0, i = 0; i < faces.size(); i++) {
      if (faces[i].first != faces[first].first) first = i;
      if (faces[i].second != faces[first].second) repeated[faces[i].second]++;
    }
    return repeated;
  }

 private:
  static constexpr uint32_t nowhere = 0xffffffffu;

  std::vector<const Mesh*> meshes_;
  std::vector<std::tuple<Vec3f, uint32_t, uint32_t>> sorted_;  // position, mesh, vertex
  std::vector<std::vector<uint32_t>> of_;
};

/// Those whose surface, or a part of it, is a lamp.
std::set<int> primitives_of_lamps(const Scene& scene, std::span<const ClientLamp> lamps) {
  std::set<std::pair<int, int>> named;  // by node, and by its place in the mesh
  for (const ClientLamp& lamp : lamps)
    if (lamp.luminaire.kind == LuminaireId::Kind::surface) named.emplace(lamp.luminaire.node, lamp.luminaire.primitive);
  std::set<int> found;
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
    if (named.contains({instance.node, primitive.source_primitive})) found.insert(instance.primitive);
  }
  return found;
}

class Grouping {
 public:
  Grouping(const Scene& scene, std::span<const float> most_errors) : scene_(scene), most_errors_(most_errors) {}

  void add(const MeshGroup& alike) {
    if (alike.size() == 1) {
      groups_.push_back(alike);
      return;
    }
    const Places places(scene_, alike);
    const std::vector<bool> apart = coats(places, alike);
    DisjointSets sets = places.touching(apart);
    std::map<size_t, MeshGroup> pieces;
    for (size_t i = 0; i < alike.size(); i++)
      if (apart[i])
        groups_.push_back({alike[i]});
      else
        pieces[sets.of(i)].push_back(alike[i]);
    MeshGroup small;
    size_t vertices_of_small = 0;
    const auto close = [&] {
      add_fitting(std::exchange(small, {}));
      vertices_of_small = 0;
    };
    for (const auto& [first, piece] : pieces) {
      const size_t vertices = vertices_of(piece);
      if (vertices > many_vertices || piece.size() > MeshLayout::most_regions) {
        add_fitting(piece);
        continue;
      }
      if (vertices_of_small + vertices > most_vertices_of_a_group ||
          small.size() + piece.size() > MeshLayout::most_regions)
        close();
      small.insert(small.end(), piece.begin(), piece.end());
      vertices_of_small += vertices;
    }
    close();
  }

  std::vector<MeshGroup> release() {
    std::ranges::sort(groups_);
    return std::move(groups_);
  }

 private:
  /// Which of some primitives lie on others, in another material or as their back: an edge of four faces collapses to
  /// no form that both have, so that it would stay while all else of the group goes.
  std::vector<bool> coats(const Places& places, const MeshGroup& alike) const {
    constexpr size_t few = 50;  // one face in so many may be a decal's
    const std::vector<size_t> repeated = places.repeated();
    std::vector<bool> found;
    for (size_t i = 0; i < alike.size(); i++)
      found.push_back(few * repeated[i] > scene_.primitives[static_cast<size_t>(alike[i])].mesh.faces.size());
    return found;
  }

  size_t vertices_of(const MeshGroup& group) const {
    size_t vertices = 0;
    for (const int i : group) vertices += scene_.primitives[static_cast<size_t>(i)].mesh.positions.size();
    return vertices;
  }

  /// Adds a group, and what is too fine for it by itself.
  void add_fitting(MeshGroup group) {
    std::ranges::sort(group);
    Box3f all;
    for (const int i : group) all.extend(scene_.primitives[static_cast<size_t>(i)].mesh.bounds());
    MeshGroup fitting;
    for (const int i : group) {
      const bool fits = 2 * most_errors_[static_cast<size_t>(i)] * steps_of_all >= max_component(all.size());
      if (fits && fitting.size() < MeshLayout::most_regions)
        fitting.push_back(i);
      else
        groups_.push_back({i});
    }
    if (!fitting.empty()) groups_.push_back(std::move(fitting));
  }

  const Scene& scene_;
  std::span<const float> most_errors_;
  std::vector<MeshGroup> groups_;
};

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::vector<MeshGroup> mesh_groups(const Scene& scene, std::span<const float> most_errors,
                                   std::span<const ClientLamp> lamps) {
  const std::set<int> lit = primitives_of_lamps(scene, lamps);
  std::map<std::pair<int, unsigned>, MeshGroup> kinds;
  Grouping grouping(scene, most_errors);
  for (size_t i = 0; i < scene.primitives.size(); i++) {
    const Primitive& primitive = scene.primitives[i];
    if (primitive.mesh.faces.empty() || primitive.deforming) continue;
    if (lit.contains(static_cast<int>(i)))
      grouping.add({static_cast<int>(i)});
    else
      kinds[{primitive.source_mesh, attributes_of(primitive.mesh)}].push_back(static_cast<int>(i));
  }
  for (const auto& [kind, alike] : kinds) grouping.add(alike);
  return grouping.release();
}

UnitedMesh united(const Scene& scene, const MeshGroup& group) {
  UnitedMesh out;
  for (size_t region = 0; region < group.size(); region++) {
    const Mesh& mesh = scene.primitives[static_cast<size_t>(group[region])].mesh;
    const auto first = static_cast<uint32_t>(out.mesh.positions.size());
    append(out.mesh.positions, mesh.positions);
    append(out.mesh.normals, mesh.normals);
    for (size_t set = 0; set < 2; set++) append(out.mesh.texcoords[set], mesh.texcoords[set]);
    append(out.mesh.colors, mesh.colors);
    out.region_of_vertex.resize(out.mesh.positions.size(), static_cast<uint16_t>(region));
    for (Face face : mesh.faces) {
      for (uint32_t& v : face) v += first;
      out.mesh.faces.push_back(face);
    }
  }
  return out;
}

}  // namespace lightwell
