// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/part_table.h"

#include <algorithm>

#include "lightwell/mesh/connected_faces.h"

namespace lightwell {
namespace {

/// The pieces of a mesh, in the order of their least vertices, and which of them touch.
struct Pieces {
  std::vector<uint32_t> of_face;
  std::vector<uint32_t> least_vertex;    ///< of each piece
  std::vector<uint32_t> first_touching;  ///< of each piece the first one that has a place in common; maybe itself

  explicit Pieces(const Mesh& mesh) {
    const std::vector<uint32_t> joined = joined_vertices(mesh);
    for (const Face& face : mesh.faces) least_vertex.push_back(joined[face[0]]);
    std::sort(least_vertex.begin(), least_vertex.end());
    least_vertex.erase(std::unique(least_vertex.begin(), least_vertex.end()), least_vertex.end());
    std::vector<uint32_t> number(joined.size());
    for (uint32_t piece = 0; piece < least_vertex.size(); piece++) number[least_vertex[piece]] = piece;
    for (const Face& face : mesh.faces) of_face.push_back(number[joined[face[0]]]);

    const std::vector<uint32_t> place = welded_vertices(mesh.positions);
    constexpr uint32_t none = ~0u;
    std::vector<uint32_t> first_at(place.size(), none);
    for (size_t f = 0; f < of_face.size(); f++)
      for (const uint32_t v : mesh.faces[f]) first_at[place[v]] = std::min(first_at[place[v]], of_face[f]);
    first_touching.assign(least_vertex.size(), none);
    for (size_t f = 0; f < of_face.size(); f++)
      for (const uint32_t v : mesh.faces[f]) {
        uint32_t& first = first_touching[of_face[f]];
        first = std::min(first, first_at[place[v]]);
      }
  }
};

}  // namespace

std::vector<uint32_t> part_table(const Mesh& mesh, std::span<const uint32_t> part_of_vertex) {
  const Pieces pieces(mesh);
  std::vector<uint32_t> table;
  for (uint32_t piece = 0; piece < pieces.least_vertex.size(); piece++) {
    const uint32_t part = part_of_vertex[pieces.least_vertex[piece]], other = pieces.first_touching[piece];
    table.push_back(other < piece && part_of_vertex[pieces.least_vertex[other]] == part ? 0 : part + 1);
  }
  return table;
}

Result<std::vector<uint32_t>> parts_of_faces(const Mesh& mesh, std::span<const uint32_t> table, uint32_t parts) {
  const Pieces pieces(mesh);
  if (table.size() != pieces.least_vertex.size()) return fail("", "does not have a number for each piece of its mesh");
  std::vector<uint32_t> part_of_piece;
  for (uint32_t piece = 0; piece < table.size(); piece++) {
    const uint32_t other = pieces.first_touching[piece];
    if (table[piece] > parts || (table[piece] == 0 && other >= piece))
      return fail("", "names a part that is not there");
    part_of_piece.push_back(table[piece] > 0 ? table[piece] - 1 : part_of_piece[other]);
  }
  std::vector<uint32_t> found;
  for (const uint32_t piece : pieces.of_face) found.push_back(part_of_piece[piece]);
  return found;
}

}  // namespace lightwell
