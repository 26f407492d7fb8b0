// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "lightwell/mesh/progressive.h"
#include "lightwell/mesh/stream.h"

namespace lightwell {

/// A face's corner as a viewer sees it; the order is any.
using Corner = std::tuple<Vec3f, Vec3f, Vec2f, Vec2f, Vec4f>;
using Corners = std::array<Corner, 3>;

inline Corner corner_of(const Mesh& mesh, uint32_t v) {
  return {mesh.positions[v], mesh.normals.empty() ? Vec3f{} : mesh.normals[v],
          mesh.texcoords[0].empty() ? Vec2f{} : mesh.texcoords[0][v],
          mesh.texcoords[1].empty() ? Vec2f{} : mesh.texcoords[1][v], mesh.colors.empty() ? Vec4f{} : mesh.colors[v]};
}

/// All oriented faces as a sorted list that does not depend on their order nor on which corner comes first.
inline std::vector<Corners> faces_of(const Mesh& mesh) {
  std::vector<Corners> faces;
  for (const Face& f : mesh.faces) {
    Corners c{corner_of(mesh, f[0]), corner_of(mesh, f[1]), corner_of(mesh, f[2])};
    const Corners b{c[1], c[2], c[0]}, a{c[2], c[0], c[1]};
    faces.push_back(std::min({c, b, a}));
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// The level of a progressive mesh below vertex n, by its definition.
inline Mesh level_of(const ProgressiveMesh& progressive, uint32_t n) {
  Mesh mesh = dequantize(progressive.mesh);
  const bool complete = n == mesh.positions.size();
  const size_t refined = mesh.faces.size() - (complete ? 0 : progressive.loose_faces);
  std::vector<Face> faces;
  for (size_t f = 0; f < refined; f++) {
    Face face = mesh.faces[f];
    for (uint32_t& v : face) v = progressive.ancestor(v, n);
    const auto at = [&](size_t k) { return progressive.point_of(face[k]); };
    const bool loose = f >= mesh.faces.size() - progressive.loose_faces;
    if (loose || (at(0) != at(1) && at(1) != at(2) && at(2) != at(0))) faces.push_back(face);
  }
  mesh.faces = faces;
  return mesh;
}

/// What a client has after opening a stream: the arrays of the base as glTF accessors give them.
struct OpenedBase {
  explicit OpenedBase(const Mesh& base) : mesh(base) {
    for (const Face& f : base.faces) indices.insert(indices.end(), f.begin(), f.end());
    for (const Vec4f& c : base.colors) colors.push_back(color_value(color_code(c)));
  }
  MeshArrays arrays() const {
    MeshArrays a;
    a.positions = mesh.positions;
    a.normals = mesh.normals;
    for (size_t set = 0; set < 2; set++) a.texcoords[set] = mesh.texcoords[set];
    a.colors = colors;
    a.indices = indices;
    return a;
  }

  Mesh mesh;
  std::vector<Color16> colors;
  std::vector<uint32_t> indices;
};

inline uint64_t stream_bytes(const EncodedMesh& encoded) {
  uint64_t sum = 0;
  for (const MeshBlock& block : encoded.blocks) sum += block.payload.size();
  return sum;
}

/// What a decoder shows now, of a region. Normals are rounded to its 16 bits.
inline Mesh shown(const MeshDecoder& decoder, size_t region = 0) {
  Mesh mesh;
  const uint32_t count = decoder.vertices();
  mesh.positions.assign(decoder.positions().begin(), decoder.positions().begin() + count);
  if (!decoder.normals().empty())
    for (uint32_t v = 0; v < count; v++) {
      const Normal16& n = decoder.normals()[v];
      mesh.normals.push_back(Vec3f{{float(n[0]), float(n[1]), float(n[2])}});
    }
  for (int set = 0; set < 2; set++)
    if (!decoder.texcoords(set).empty())
      mesh.texcoords[static_cast<size_t>(set)].assign(decoder.texcoords(set).begin(),
                                                      decoder.texcoords(set).begin() + count);
  if (!decoder.colors().empty())
    for (uint32_t v = 0; v < count; v++) mesh.colors.push_back(color_of(decoder.colors()[v]));
  const auto indices = decoder.indices(region);
  for (size_t i = 0; i < indices.size(); i += 3) mesh.faces.push_back({indices[i], indices[i + 1], indices[i + 2]});
  return mesh;
}

/// The same rounding of normals for a mesh that no decoder made.
inline Mesh with_normals_in_16_bits(Mesh mesh) {
  for (Vec3f& n : mesh.normals)
    for (int i = 0; i < 3; i++) n[i] = std::floor(n[i] * 32767.0f + 0.5f);
  return mesh;
}

}  // namespace lightwell
