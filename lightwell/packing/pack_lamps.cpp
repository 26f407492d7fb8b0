// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_lamps.h"

#include <algorithm>
#include <optional>
#include <set>
#include <span>

#include "lightwell/mesh/connected_faces.h"
#include "lightwell/mesh/progressive.h"

namespace lightwell {
namespace {

/// The scene primitive that a luminaire is a part of, or -1.
int primitive_of(const LuminaireId& id, const Scene& scene) {
  for (const Instance& instance : scene.instances)
    if (instance.node == id.node &&
        scene.primitives[static_cast<size_t>(instance.primitive)].source_primitive == id.primitive)
      return instance.primitive;
  return -1;
}

/// The positions of all corners of the connected piece of surface that contains `vertex`.
std::set<Vec3f> places_of_piece(const Mesh& mesh, uint32_t vertex) {
  const std::vector<uint32_t> pieces = connected_faces(mesh);
  const auto found = std::find_if(mesh.faces.begin(), mesh.faces.end(), [&](const Face& face) {
    return std::find(face.begin(), face.end(), vertex) != face.end();
  });
  std::set<Vec3f> places;
  if (found == mesh.faces.end()) return places;
  const uint32_t piece = pieces[static_cast<size_t>(found - mesh.faces.begin())];
  for (size_t i = 0; i < pieces.size(); i++)
    if (pieces[i] == piece)
      for (const uint32_t corner : mesh.faces[i]) places.insert(mesh.positions[corner]);
  return places;
}

/// The faces of a region in the coarsest level.
std::span<const Face> base_faces(const EncodedMesh& encoded, size_t region) {
  std::span<const Face> faces = encoded.base.faces;
  const std::vector<RegionLayout>& regions = encoded.layout.regions;
  for (size_t i = 0; i < region; i++) faces = faces.subspan(regions[i].base_faces);
  return regions.empty() ? faces : faces.first(regions[region].base_faces);
}

/// The vertex of a region's coarsest level that lies where a corner of the piece of surface containing `vertex` does;
/// the first of such. There is none where the whole piece is smaller than a step of the lattice: then the stream has no
/// face of it.
std::optional<uint32_t> vertex_in_stream(const Mesh& mesh, uint32_t vertex, const EncodedMesh& encoded, size_t region) {
  const std::set<Vec3f> places = places_of_piece(mesh, vertex);
  const auto moved = [](const Vec3f& from, const Vec3f& to) { return max_component(max(to - from, from - to)); };
  float nearest = 0.501f * encoded.layout.step_of(region);  // more than half, since floats round
  uint32_t first = no_vertex;
  for (const Face& face : base_faces(encoded, region))
    for (const uint32_t corner : face)
      for (const Vec3f& place : places) {
        const float distance = moved(place, encoded.base.positions[corner]);
        if (distance > nearest || (distance == nearest && corner >= first)) continue;
        nearest = distance;
        first = corner;
      }
  if (first == no_vertex) return {};
  return first;
}

}  // namespace

std::vector<ClientLamp> lamps_of_pack(std::span<const ClientLamp> lamps, const Scene& scene,
                                      std::span<const StreamedMesh> streamed) {
  std::vector<ClientLamp> renamed(lamps.begin(), lamps.end());
  for (ClientLamp& lamp : renamed) {
    if (lamp.luminaire.kind != LuminaireId::Kind::surface) continue;
    const int primitive = primitive_of(lamp.luminaire, scene);
    for (const StreamedMesh& mesh : streamed) {
      const auto found = std::ranges::find(mesh.primitives, primitive);
      if (found == mesh.primitives.end()) continue;
      const auto region = static_cast<size_t>(found - mesh.primitives.begin());
      const Mesh& source =
          mesh.deforming ? mesh.deforming->mesh : scene.primitives[static_cast<size_t>(primitive)].mesh;
      const auto vertex = vertex_in_stream(source, lamp.luminaire.vertex, mesh.encoded, region);
      lamp.luminaire = vertex ? lamp.luminaire : LuminaireId{.kind = LuminaireId::Kind::surface};
      if (vertex) lamp.luminaire.vertex = *vertex;
    }
  }
  return renamed;
}

}  // namespace lightwell
