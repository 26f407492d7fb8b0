// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/solids.h"

#include "lightwell/mesh/connected_faces.h"
#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

/// Least volume of a solid, relative to a ball of the same area: a sheet has 0, a pane 1 m square and 4 mm thick 1.5 %.
constexpr double least_volume = 1e-3;
/// What a scan's holes may lack of its surface.
constexpr double most_missing = 0.05;
/// The most light on the back, relative to the front, with which a piece still has a dark inside: of one that is closed
/// but for cracks, and of one that may have holes, through which some light comes in and is reflected.
constexpr double most_light_inside = 1e-3, most_light_through_holes = 0.12;
/// Fewer hits cannot show a share of one in a thousand.
constexpr uint64_t least_hits = 1000;
/// Enough hits to tell a share of one in a thousand from two in a thousand, by four standard deviations.
constexpr uint64_t enough_hits = 16 * least_hits;

/// Sums over the faces of a piece.
struct Extent {
  double area = 0;
  Vec3d center{};      // times the area
  Vec3d normal_sum{};  // sum of area vectors
  double moment = 0;   // signed volume between the faces and the origin
};

Extent& operator+=(Extent& sum, const std::array<Vec3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec3d normal = cross(b - a, c - a) * 0.5;
  const double area = length(normal);
  sum.area += area;
  sum.center += (a + b + c) * (area / 3);
  sum.normal_sum += normal;
  sum.moment += dot(a, normal) / 3;
  return sum;
}

/// Whether little of a closed surface is missing: the area vectors of a closed one add up to nothing, those of the rest
/// to what it lacks. An open tube passes too; its back is lit.
bool nearly_closed(const Extent& piece) { return length(piece.normal_sum) <= most_missing * piece.area; }

/// Whether the volume between the surface and its own centre is large enough. For an open surface, which has no volume
/// of its own, measuring from the centre makes the result independent of its place.
bool encloses_volume(const Extent& piece) {
  if (!(piece.area > 0)) return false;
  const double volume = piece.moment - dot(piece.center / piece.area, piece.normal_sum) / 3;
  const double ball = piece.area * std::sqrt(piece.area / (36 * static_cast<double>(pi)));
  return std::abs(volume) > least_volume * ball;
}

}  // namespace

Solids::Solids(const TraceScene& scene)
    : scene_(scene), pieces_of_faces_(scene.scene().primitives.size()), first_piece_(scene.scene().primitives.size()) {
  for (uint32_t i = 0; i < scene.scene().instances.size(); i++) {
    if (!scene.traced(i) || !scene.material(i).double_sided) continue;
    const auto primitive = static_cast<size_t>(scene.scene().instances[i].primitive);
    if (!pieces_of_faces_[primitive].empty()) continue;
    const Mesh& mesh = scene.scene().primitives[primitive].mesh;
    pieces_of_faces_[primitive] = connected_faces(mesh);
    first_piece_[primitive] = encloses_.size();
    add_pieces(mesh, pieces_of_faces_[primitive]);
  }
  solid_.assign(encloses_.size(), 0);
}

void Solids::add_pieces(const Mesh& mesh, const std::vector<uint32_t>& of_faces) {
  std::vector<Extent> extents(*std::max_element(of_faces.begin(), of_faces.end()) + 1);
  for (size_t i = 0; i < of_faces.size(); i++) {
    const Face& face = mesh.faces[i];
    extents[of_faces[i]] += {mesh.positions[face[0]].cast<double>(), mesh.positions[face[1]].cast<double>(),
                             mesh.positions[face[2]].cast<double>()};
  }
  for (const Extent& extent : extents) {
    encloses_.push_back(encloses_volume(extent));
    most_inside_.push_back(nearly_closed(extent) ? most_light_through_holes : most_light_inside);
  }
}

Solids::Hits& Solids::Hits::operator+=(const Hits& other) {
  for (size_t i = 0; i < front.size(); i++) {
    front[i] += other.front[i];
    back[i] += other.back[i];
  }
  return *this;
}

Solids::Hits Solids::no_hits() const {
  return {std::vector<uint64_t>(solid_.size()), std::vector<uint64_t>(solid_.size())};
}

std::optional<size_t> Solids::piece(const Hit& hit) const {
  const auto primitive = static_cast<size_t>(scene_.scene().instances[hit.instance].primitive);
  const std::vector<uint32_t>& of_faces = pieces_of_faces_[primitive];
  if (of_faces.empty()) return {};
  return first_piece_[primitive] + of_faces[hit.face];
}

void Solids::count(const Hit& hit, Hits& hits) const {
  if (const auto index = piece(hit)) (hit.front ? hits.front : hits.back)[*index]++;
}

bool Solids::settled(const Hits& hits) const {
  for (size_t i = 0; i < encloses_.size(); i++)
    if (encloses_[i] && hits.front[i] + hits.back[i] < enough_hits) return false;
  return true;
}

void Solids::decide(const Hits& hits) {
  for (size_t i = 0; i < solid_.size(); i++)
    solid_[i] = encloses_[i] && hits.front[i] >= least_hits &&
                static_cast<double>(hits.back[i]) <= most_inside_[i] * static_cast<double>(hits.front[i]);
}

bool Solids::from_inside(const Hit& hit) const {
  if (hit.front) return false;
  const auto index = piece(hit);
  return !index || solid_[*index];
}

}  // namespace lightwell
