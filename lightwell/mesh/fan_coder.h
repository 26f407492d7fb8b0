// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "lightwell/base/model_coder.h"
#include "lightwell/mesh/refinement.h"

namespace lightwell {

/// Codes which faces of a parent's fan move to a new vertex. They are mostly one run: its length is coded with the
/// fan's size in view, and its place as the rank among all runs of that length, those of the longest edges first, since
/// a vertex that collapses onto the nearest neighbour leaves its faces long. Anything else takes a bit for each face.
class FanCoder {
 public:
  /// Codes v.moves, which has an entry for each face of v.fan. False if no encoder writes such a stream.
  template <typename Coder>
  bool moves(Coder& coder, const Refinement& mesh, NewVertex& v) {
    // A fan of several pieces may pass for closed: then its runs may go over a gap.
    const bool closed = !v.fan.empty() && v.fan.front().a == v.fan.back().b;
    Run run;
    if (Coder::writes) run = run_of(v.moves, closed);
    if (run.length > 0 && !weigh_runs(mesh, v, closed, run.length)) run.length = 0;
    if (run.length > 0 && rank_of(run.first) >= ranks) run.length = 0;
    if (coder.bit(is_run_[closed], run.length > 0)) return in_run(coder, mesh, closed, run, v);
    uint8_t last = 0;
    for (uint8_t& move : v.moves) last = move = coder.bit(moves_[last], move != 0);
    return true;
  }

 private:
  static constexpr int bits = 4;
  static constexpr uint32_t ranks = 1 << bits, longest = ranks - 1;

  /// The faces from `first` on, round the fan; of no length where the moving ones are no run.
  struct Run {
    uint32_t first = 0, length = 0;
  };

  static Run run_of(const std::vector<uint8_t>& moves, bool closed) {
    Run run;
    uint32_t begins = 0;
    for (size_t i = 0; i < moves.size(); i++) {
      run.length += moves[i];
      const bool before = i > 0 ? moves[i - 1] : closed && moves.back();
      if (!moves[i] || before) continue;
      run.first = static_cast<uint32_t>(i);
      begins++;
    }
    return begins > 1 || run.length > longest ? Run{} : run;
  }

  template <typename Coder>
  bool in_run(Coder& coder, const Refinement& mesh, bool closed, Run run, NewVertex& v) {
    const auto size = static_cast<uint32_t>(v.fan.size());
    run.length = coder.symbol(length_[closed][std::min(size, 15u)], run.length);
    if (!Coder::writes && !weigh_runs(mesh, v, closed, run.length)) return false;  // a writer has weighed them
    const auto places = static_cast<uint32_t>(weights_.size());
    if (places > 1) {
      AdaptiveSymbol<bits>& model = rank_[std::min(run.length, 7u)][std::min(places, 15u)];
      const uint32_t rank = coder.symbol(model, Coder::writes ? rank_of(run.first) : 0);
      if (!Coder::writes) run.first = of_rank(rank);
      if (run.first >= places) return false;
    }
    std::ranges::fill(v.moves, uint8_t(0));
    for (uint32_t i = 0; i < run.length; i++) v.moves[(run.first + i) % size] = 1;
    return true;
  }

  /// Weighs all runs of a length: the sum of the squared edges from the parent to the corners of their faces. False
  /// when there is none.
  bool weigh_runs(const Refinement& mesh, const NewVertex& v, bool closed, uint32_t length) {
    const size_t size = v.fan.size();
    if (length == 0 || length > size) return false;
    const Vec3i parent = mesh.position(v.parent);
    const auto squared_edge = [&](uint32_t corner) {
      const Vec<int64_t, 3> edge = (mesh.position(corner) - parent).cast<int64_t>();
      return dot(edge, edge);
    };
    faces_.clear();
    uint32_t last = v.parent;
    int64_t of_last = 0;
    for (const Spoke& spoke : v.fan) {
      const int64_t a = spoke.a == last ? of_last : squared_edge(spoke.a);
      of_last = squared_edge(last = spoke.b);
      faces_.push_back(a + of_last);
    }
    weights_.clear();
    int64_t weight = 0;
    for (size_t i = 0; i < length; i++) weight += faces_[i];
    const size_t places = length == size ? 1 : closed ? size : size - length + 1;
    for (size_t run = 0; run < places; run++) {
      weights_.push_back(weight);
      weight += faces_[(run + length) % size] - faces_[run];
    }
    return true;
  }

  /// Whether a run comes before another: heavier ones do, and of equal ones the first.
  bool before(size_t run, size_t other) const {
    return weights_[run] > weights_[other] || (weights_[run] == weights_[other] && run < other);
  }

  uint32_t rank_of(size_t run) const {
    uint32_t rank = 0;
    for (size_t i = 0; i < weights_.size(); i++) rank += before(i, run);
    return rank;
  }

  /// The run of a rank, mostly one of the first; as many as there are if there is none.
  uint32_t of_rank(uint32_t rank) const {
    const auto count = static_cast<uint32_t>(weights_.size());
    uint32_t last = count;
    for (uint32_t step = 0; step <= rank; step++) {
      uint32_t next = count;
      for (uint32_t i = 0; i < count; i++)
        if ((last == count || before(last, i)) && (next == count || before(i, next))) next = i;
      if (next == count) return count;
      last = next;
    }
    return last;
  }

  std::array<AdaptiveBit, 2> is_run_;
  std::array<std::array<AdaptiveSymbol<bits>, 16>, 2> length_;
  std::array<std::array<AdaptiveSymbol<bits>, 16>, 8> rank_;
  std::array<AdaptiveBit, 2> moves_;
  std::vector<int64_t> faces_, weights_;  // of the faces of the fan, and of its runs
};

}  // namespace lightwell
