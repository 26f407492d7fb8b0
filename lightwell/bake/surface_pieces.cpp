// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/surface_pieces.h"

#include <algorithm>

#include "lightwell/mesh/connected_faces.h"

namespace lightwell {
namespace {

/// What a scan's holes may lack of its surface.
constexpr double most_missing = 0.05;

}  // namespace

void PieceExtent::add(const std::array<Vec3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec3d normal = cross(b - a, c - a) * 0.5;
  const double part = length(normal);
  area += part;
  center += (a + b + c) * (part / 3);
  normal_sum += normal;
  moment += dot(a, normal) / 3;
}

bool PieceExtent::nearly_closed() const { return length(normal_sum) <= most_missing * area; }

double PieceExtent::volume() const { return area > 0 ? moment - dot(center / area, normal_sum) / 3 : 0; }

SurfacePieces::SurfacePieces(const TraceScene& scene, const std::function<bool(uint32_t)>& chosen)
    : scene_(scene), of_faces_(scene.scene().primitives.size()), first_(scene.scene().primitives.size()) {
  for (uint32_t i = 0; i < scene.scene().instances.size(); i++) {
    const auto primitive = static_cast<size_t>(scene.scene().instances[i].primitive);
    if (!scene.traced(i) || !of_faces_[primitive].empty() || !chosen(i)) continue;
    const Mesh& mesh = scene.scene().primitives[primitive].mesh;
    of_faces_[primitive] = connected_faces(mesh);
    const std::vector<uint32_t>& of_faces = of_faces_[primitive];
    first_[primitive] = extents_.size();
    extents_.resize(extents_.size() + *std::max_element(of_faces.begin(), of_faces.end()) + 1);
    for (size_t face = 0; face < of_faces.size(); face++) {
      const auto corner = [&](size_t k) { return mesh.positions[mesh.faces[face][k]].cast<double>(); };
      extents_[first_[primitive] + of_faces[face]].add({corner(0), corner(1), corner(2)});
    }
  }
}

std::optional<size_t> SurfacePieces::piece(const Hit& hit) const {
  const auto primitive = static_cast<size_t>(scene_.scene().instances[hit.instance].primitive);
  if (of_faces_[primitive].empty()) return {};
  return first_[primitive] + of_faces_[primitive][hit.face];
}

void SurfacePieces::for_each_face(size_t primitive, const std::function<void(size_t, size_t)>& body) const {
  const std::vector<uint32_t>& of_faces = of_faces_[primitive];
  for (size_t face = 0; face < of_faces.size(); face++) body(face, first_[primitive] + of_faces[face]);
}

}  // namespace lightwell
