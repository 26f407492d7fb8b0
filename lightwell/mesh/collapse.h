// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/base/progress.h"
#include "lightwell/base/result.h"
#include "lightwell/mesh/quantize.h"

namespace lightwell {

inline constexpr uint32_t no_vertex = 0xffffffffu;

/// The points (distinct positions) of a mesh. The vertices of a point follow one another.
struct Points {
  std::vector<uint32_t> first;  ///< point i has the vertices first[i] up to first[i + 1]
  std::vector<uint32_t> of;     ///< the point of each vertex

  explicit Points(const std::vector<Vec3i>& positions);
  uint32_t count() const { return static_cast<uint32_t>(first.size() - 1); }
};

/// The order in which the points of a mesh, with all their vertices, collapse onto neighbours. Nothing moves.
struct CollapseOrder {
  /// Independent collapses: no two removed points share a face, and no target is removed.
  struct Round {
    std::vector<uint32_t> removed;  ///< points
    float error = 0;                ///< root mean square distance to the input after this round; an estimate
  };

  static constexpr uint32_t never = 0xffffffffu, loose = 0xfffffffeu;

  std::vector<Round> rounds;       ///< fine to coarse
  std::vector<uint32_t> target;    ///< of each point: the one it collapses onto; itself if it stays
  std::vector<uint32_t> parent;    ///< of each vertex: the one that replaces it; itself if it stays
  std::vector<uint32_t> vanished;  ///< of each face: the vertex whose collapse removes it, `never` or `loose`

  /// Undoes all rounds after the first `count`.
  void keep_rounds(size_t count, const Points& points);
};

/// Collapses the points of a mesh until at most `vertices` vertices are left or hardly anything can collapse any more.
/// No kind of collapse is forbidden, so that any mesh becomes small: one that would change the topology, flip a face or
/// tear attributes is charged an error of the size of what may vanish. Only the last face of a region is never removed.
/// Faces that have two corners at one point or repeat another of their region are loose: they take no part. Fails only
/// when cancelled.
///
/// The cost is the quadric error metric of M. Garland and P. Heckbert ("Surface Simplification Using Quadric Error
/// Metrics", SIGGRAPH 1997). Unlike in the paper, a point collapses onto a neighbour and nothing moves (half-edge
/// collapse), and instead of the cheapest collapse each time there are rounds of independent ones, as in the
/// hierarchies of D. Dobkin and D. Kirkpatrick (1985).
Result<CollapseOrder> collapse_order(const QuantizedMesh& mesh, const Points& points, uint32_t vertices,
                                     Progress& progress);

}  // namespace lightwell
