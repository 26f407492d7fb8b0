// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/solids.h"

#include "lightwell/trace/connected_faces.h"

namespace lightwell {

Solids::Solids(const TraceScene& scene)
    : scene_(scene),
      pieces_of_faces_(scene.scene().primitives.size()),
      first_piece_(scene.scene().instances.size(), none) {
  size_t pieces = 0;
  for (uint32_t i = 0; i < first_piece_.size(); i++) {
    if (!scene.traced(i) || !scene.material(i).double_sided) continue;
    const size_t primitive = static_cast<size_t>(scene.scene().instances[i].primitive);
    std::vector<uint32_t>& of_faces = pieces_of_faces_[primitive];
    if (of_faces.empty()) of_faces = connected_faces(scene.scene().primitives[primitive].mesh);
    first_piece_[i] = static_cast<int>(pieces);
    pieces += *std::max_element(of_faces.begin(), of_faces.end()) + 1;
  }
  solid_.assign(pieces, 0);
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

int Solids::piece(const Hit& hit) const {
  const int first = first_piece_[hit.instance];
  if (first == none) return none;
  const size_t primitive = static_cast<size_t>(scene_.scene().instances[hit.instance].primitive);
  return first + static_cast<int>(pieces_of_faces_[primitive][hit.face]);
}

void Solids::count(const Hit& hit, Hits& hits) const {
  const int index = piece(hit);
  if (index != none) (hit.front ? hits.front : hits.back)[static_cast<size_t>(index)]++;
}

void Solids::decide(const Hits& hits) {
  for (size_t i = 0; i < solid_.size(); i++) solid_[i] = hits.back[i] * 1000 <= hits.front[i];
}

bool Solids::from_inside(const Hit& hit) const {
  if (hit.front) return false;
  const int index = piece(hit);
  return index == none || solid_[static_cast<size_t>(index)];
}

}  // namespace lightwell
