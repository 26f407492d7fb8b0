// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/collapse.h"

#include <algorithm>
#include <numeric>

#include "lightwell/mesh/collapse_state.h"

namespace lightwell {
namespace {

// A round that removes less than one point in so many is the last, which bounds the number of a decoder's passes.
constexpr size_t least_yield = 128;
// Share of the points, cheapest first, that a round considers. About half of them are independent of each other.
constexpr double considered = 0.5;

// Simplifies a mesh round by round.
class Simplifier {
 public:
  Simplifier(const QuantizedMesh& mesh, const Points& points)
      : points_(points), state_(mesh, points), key_(points.count(), unknown), live_(points.count()) {
    std::iota(live_.begin(), live_.end(), 0u);
    live_vertices_ = static_cast<uint32_t>(mesh.positions.size());
  }

  Result<CollapseOrder> run(uint32_t vertices, Progress& progress) {
    progress.stage("simplifying", points_.count(), "points");
    size_t before = live_.size();
    while (live_vertices_ > vertices) {
      before = live_.size();
      round();
      progress.advance(static_cast<double>(points_.count() - live_.size()));
      if (progress.cancelled()) return fail(ErrorKind::cancelled, "simplification", "cancelled");
      if ((before - live_.size()) * least_yield < before) break;
    }
    return state_.release(std::move(rounds_));
  }

 private:
  static constexpr float unknown = -1, infinite = std::numeric_limits<float>::infinity();

  void round() {
    state_.begin_round(live_);
    for (const uint32_t v : live_)
      if (key_[v] == unknown || key_[v] == infinite) key_[v] = state_.least_cost(v);
    const float error_before = rounds_.empty() ? 0 : rounds_.back().error;
    rounds_.emplace_back();
    squared_errors_ = 0;
    // A key may be only a lower bound. If too few collapses were as cheap as their keys, sweep again.
    bool corrected = true;
    while (corrected && rounds_.back().removed.size() * least_yield < live_.size()) corrected = sweep(threshold());
    if (rounds_.back().removed.empty())
      rounds_.pop_back();
    else
      rounds_.back().error = std::max(error_before, root_mean_square_error(rounds_.back().removed.size()));
    std::erase_if(live_, [&](uint32_t v) { return state_.removed(v); });
  }

  float root_mean_square_error(size_t collapses) const {
    return static_cast<float>(std::sqrt(squared_errors_ / static_cast<double>(collapses)));
  }

  float threshold() {
    sorted_.clear();
    for (const uint32_t v : live_)
      if (!state_.locked(v) && key_[v] != infinite) sorted_.push_back(key_[v]);
    if (sorted_.empty()) return 0;
    const auto middle = sorted_.begin() + static_cast<ptrdiff_t>(static_cast<double>(sorted_.size() - 1) * considered);
    std::nth_element(sorted_.begin(), middle, sorted_.end());
    return *middle;
  }

  // Makes the collapses that cost at most the threshold; true when the cost of one turned out to be above it.
  bool sweep(float threshold) {
    bool corrected = false;
    CollapseOrder::Round& round = rounds_.back();
    for (size_t i = 0; i < live_.size(); i++) {
      const uint32_t v = live_[i];
      if (state_.locked(v) || key_[v] > threshold) continue;
      const CollapseState::Choice choice = state_.isolated(v) ? onto_neighbour_in_list(i) : state_.choose(v);
      if (choice.cost > threshold) {
        corrected = true;
        key_[v] = choice.cost;
        continue;
      }
      for (const uint32_t w : state_.collapse(v, choice.target)) key_[w] = unknown;
      round.removed.push_back(v);
      squared_errors_ += double(choice.error) * choice.error;
      live_vertices_ -= points_.first[v + 1] - points_.first[v];
    }
    return corrected;
  }

  // A point that has lost its faces is invisible and collapses for free, onto a neighbour on the Morton curve. It stays
  // while both neighbours have too many faces to be split.
  CollapseState::Choice onto_neighbour_in_list(size_t i) const {
    for (const size_t j : {i - 1, i + 1})
      if (j < live_.size() && !state_.removed(live_[j]) && state_.can_be_split(live_[j])) return {live_[j], 0, 0};
    return {no_vertex, infinite, 0};
  }

  const Points& points_;
  CollapseState state_;
  std::vector<float> key_;  // cost of each point's collapse, or a lower bound of it
  std::vector<uint32_t> live_;
  uint32_t live_vertices_ = 0;
  std::vector<CollapseOrder::Round> rounds_;
  double squared_errors_ = 0;  // of the current round's collapses
  std::vector<float> sorted_;
};

}  // namespace

Points::Points(const std::vector<Vec3i>& positions) {
  for (size_t v = 0; v < positions.size(); v++) {
    if (v == 0 || positions[v] != positions[v - 1]) first.push_back(static_cast<uint32_t>(v));
    of.push_back(static_cast<uint32_t>(first.size() - 1));
  }
  first.push_back(static_cast<uint32_t>(positions.size()));
}

void CollapseOrder::keep_rounds(size_t count, const Points& points) {
  for (size_t i = count; i < rounds.size(); i++)
    for (const uint32_t point : rounds[i].removed) {
      target[point] = point;
      for (uint32_t v = points.first[point]; v < points.first[point + 1]; v++) parent[v] = v;
    }
  rounds.resize(std::min(count, rounds.size()));
  for (uint32_t& corner : vanished)
    if (corner != never && corner != loose && parent[corner] == corner) corner = never;
}

Result<CollapseOrder> collapse_order(const QuantizedMesh& mesh, const Points& points, uint32_t vertices,
                                     Progress& progress) {
  return Simplifier(mesh, points).run(vertices, progress);
}

}  // namespace lightwell
