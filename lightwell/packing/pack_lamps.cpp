// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_lamps.h"

#include <algorithm>
#include <optional>
#include <set>

#include "lightwell/mesh/connected_faces.h"

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

/// The lattice positions of all corners of the connected piece of surface that contains `vertex`.
std::set<Vec3i> places_of_piece(const Mesh& mesh, uint32_t vertex, const Lattice& lattice) {
  const std::vector<uint32_t> pieces = connected_faces(mesh);
  const auto found = std::find_if(mesh.faces.begin(), mesh.faces.end(), [&](const Face& face) {
    return std::find(face.begin(), face.end(), vertex) != face.end();
  });
  std::set<Vec3i> places;
  if (found == mesh.faces.end()) return places;
  const uint32_t piece = pieces[static_cast<size_t>(found - mesh.faces.begin())];
  for (size_t i = 0; i < pieces.size(); i++) {
    if (pieces[i] != piece) continue;
    for (const uint32_t corner : mesh.faces[i]) {
      const Vec3f& p = mesh.positions[corner];
      places.insert({{lattice.code(p[0]), lattice.code(p[1]), lattice.code(p[2])}});
    }
  }
  return places;
}

/// The first vertex of the coarsest level that coincides with a corner of the piece of surface containing `vertex`.
/// There is none where the whole piece is smaller than a step of the lattice: then the stream has no face of it.
std::optional<uint32_t> vertex_in_stream(const Mesh& mesh, uint32_t vertex, const EncodedMesh& encoded) {
  const Lattice& lattice = encoded.layout.positions;
  const std::set<Vec3i> places = places_of_piece(mesh, vertex, lattice);
  const std::vector<Vec3f>& base = encoded.base.positions;
  const auto found = std::find_if(base.begin(), base.end(), [&](const Vec3f& p) {
    return places.contains({{lattice.exact_code(p[0]), lattice.exact_code(p[1]), lattice.exact_code(p[2])}});
  });
  if (found == base.end()) return {};
  return static_cast<uint32_t>(found - base.begin());
}

}  // namespace

std::vector<ClientLamp> lamps_of_pack(std::span<const ClientLamp> lamps, const Scene& scene,
                                      std::span<const StreamedMesh> streamed) {
  std::vector<ClientLamp> renamed(lamps.begin(), lamps.end());
  for (ClientLamp& lamp : renamed) {
    if (lamp.luminaire.kind != LuminaireId::Kind::surface) continue;
    const int primitive = primitive_of(lamp.luminaire, scene);
    for (const StreamedMesh& mesh : streamed) {
      if (mesh.primitives[0] != primitive) continue;  // those of a lamp are alone
      const Mesh& source =
          mesh.deforming ? mesh.deforming->mesh : scene.primitives[static_cast<size_t>(primitive)].mesh;
      const auto vertex = vertex_in_stream(source, lamp.luminaire.vertex, mesh.encoded);
      lamp.luminaire = vertex ? lamp.luminaire : LuminaireId{.kind = LuminaireId::Kind::surface};
      if (vertex) lamp.luminaire.vertex = *vertex;
    }
  }
  return renamed;
}

}  // namespace lightwell
