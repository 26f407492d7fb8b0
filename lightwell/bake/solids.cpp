// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/solids.h"

#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

/// Least volume of a solid, relative to a ball of the same area: a sheet has 0, a pane 1 m square and 4 mm thick 1.5 %.
constexpr double least_volume = 1e-3;
/// The most light on the back, relative to the front, with which a piece still has a dark inside: of one that is closed
/// but for cracks, and of one that may have holes, through which some light comes in and is reflected.
constexpr double most_light_inside = 1e-3, most_light_through_holes = 0.12;
/// Fewer hits cannot show a share of one in a thousand.
constexpr uint64_t least_hits = 1000;
/// Enough hits to tell a share of one in a thousand from two in a thousand, by four standard deviations.
constexpr uint64_t enough_hits = 16 * least_hits;

bool encloses_volume(const PieceExtent& piece) {
  const double ball = piece.area * std::sqrt(piece.area / (36 * static_cast<double>(pi)));
  return std::abs(piece.volume()) > least_volume * ball;
}

}  // namespace

Solids::Solids(const TraceScene& scene)
    : pieces_(scene, [&](uint32_t instance) { return scene.material(instance).double_sided; }) {
  for (size_t i = 0; i < pieces_.count(); i++) {
    encloses_.push_back(encloses_volume(pieces_.extent(i)));
    most_inside_.push_back(pieces_.extent(i).nearly_closed() ? most_light_through_holes : most_light_inside);
  }
  solid_.assign(encloses_.size(), 0);
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

void Solids::count(const Hit& hit, Hits& hits) const {
  if (const auto index = pieces_.piece(hit)) (hit.front ? hits.front : hits.back)[*index]++;
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
  const auto index = pieces_.piece(hit);
  return !index || solid_[*index];
}

}  // namespace lightwell
