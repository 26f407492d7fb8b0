// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/mesh.h"

#include <utility>

namespace lightwell {

Box3f Mesh::bounds() const {
  Box3f box;
  for (const Vec3f& p : positions) box.extend(p);
  return box;
}

Mesh mesh_of_faces(const Mesh& vertices, std::vector<Face> faces) {
  std::vector<uint32_t> number(vertices.positions.size());
  for (const Face& face : faces)
    for (const uint32_t v : face) number[v] = 1;
  Mesh mesh;
  uint32_t next = 0;
  for (size_t v = 0; v < number.size(); v++) {
    if (number[v] == 0) continue;
    number[v] = next++;
    mesh.positions.push_back(vertices.positions[v]);
    if (!vertices.normals.empty()) mesh.normals.push_back(vertices.normals[v]);
    for (size_t set = 0; set < 2; set++)
      if (!vertices.texcoords[set].empty()) mesh.texcoords[set].push_back(vertices.texcoords[set][v]);
    if (!vertices.colors.empty()) mesh.colors.push_back(vertices.colors[v]);
  }
  for (Face& face : faces)
    for (uint32_t& v : face) v = number[v];
  mesh.faces = std::move(faces);
  return mesh;
}

std::vector<Vec3f> smooth_normals(const Mesh& mesh) {
  // In double precision, so that neither tiny nor huge triangles lose their area to underflow or overflow.
  std::vector<Vec3d> sums(mesh.positions.size());
  for (const Face& face : mesh.faces) {
    const Vec3d a = mesh.positions[face[0]].cast<double>();
    const Vec3d normal = cross(mesh.positions[face[1]].cast<double>() - a, mesh.positions[face[2]].cast<double>() - a);
    for (const uint32_t v : face) sums[v] += normal;
  }
  std::vector<Vec3f> normals(sums.size());
  for (size_t v = 0; v < sums.size(); v++) {
    const double area = length(sums[v]);
    normals[v] = area > 0 ? (sums[v] / area).cast<float>() : Vec3f{{0, 1, 0}};
  }
  return normals;
}

}  // namespace lightwell
