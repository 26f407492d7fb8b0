// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "lightwell/base/progress.h"
#include "lightwell/base/result.h"
#include "lightwell/mesh/collapse.h"
#include "lightwell/mesh/quantize.h"

namespace lightwell {

struct SimplifyOptions {
  QuantizeOptions quantize;
  /// The most vertices that the coarsest level may have; it has up to a third fewer. A mesh that cannot be simplified
  /// that far keeps more.
  uint32_t base_vertices = 300;
};

/// A mesh with the order in which it collapses. Any of its levels can become the coarsest one of a progressive mesh.
struct SimplifiedMesh {
  /// The mesh after some of the rounds.
  struct Level {
    uint32_t vertices = 0, faces = 0;
    float error = 0;  ///< distance from the final level, in the mesh's units; an estimate
  };

  QuantizedMesh mesh;
  Points points;
  CollapseOrder order;

  /// Level i is the mesh after i rounds; level 0 is the whole mesh without loose faces.
  std::vector<Level> levels() const;
};

/// A mesh whose vertices are in order of refinement: those of the coarsest level, then, pass by pass, those that splits
/// add. The level of n vertices (n not inside a point) is the final mesh with every corner replaced by its nearest
/// ancestor below n, without the faces that then have two corners at one point. This is the progressive mesh of H.
/// Hoppe ("Progressive Meshes", SIGGRAPH 1996, section 3), except that a split moves no vertex and that splits come in
/// passes of independent ones.
struct ProgressiveMesh {
  /// Independent splits, which add the points up to point_end.
  struct Pass {
    uint32_t point_end = 0;
    float error = 0;  ///< distance of the level before this pass from the final one, in the mesh's units; an estimate
  };

  /// The final level. Faces are in order of appearance; the loose ones (degenerate or repeated), which take no part in
  /// the refinement, come last.
  QuantizedMesh mesh;
  std::vector<uint32_t> parent;          ///< of each vertex: a smaller number; itself in the base
  std::vector<uint32_t> first_of_point;  ///< the vertices of point i are first_of_point[i] up to first_of_point[i + 1]
  uint32_t base_points = 0;
  uint32_t base_faces = 0;
  uint32_t loose_faces = 0;
  std::vector<uint32_t>
      appears_with;          ///< of each face that is not loose: the vertex whose split adds it; 0 in the base
  std::vector<Pass> passes;  ///< coarse to fine

  uint32_t base_vertices() const { return first_of_point[base_points]; }
  /// The point of a vertex.
  uint32_t point_of(uint32_t v) const {
    return static_cast<uint32_t>(std::upper_bound(first_of_point.begin(), first_of_point.end(), v) -
                                 first_of_point.begin() - 1);
  }
  /// The vertex below n that vertex v is refined from: itself when it is below n.
  uint32_t ancestor(uint32_t v, uint32_t n) const {
    while (v >= n) v = parent[v];
    return v;
  }
};

/// Quantises the mesh and orders it by half-edge collapse. The coarsest level has a face if any face of the mesh has
/// three different corners. Fails when a position is not finite or beyond 1e37, or when cancelled. The mesh's indices
/// must be in range.
Result<SimplifiedMesh> simplify(const Mesh& mesh, const SimplifyOptions& options, Progress& progress);

/// The progressive mesh whose coarsest level is the mesh after `rounds` rounds.
ProgressiveMesh refine_after(SimplifiedMesh mesh, size_t rounds);

/// simplify() and refine_after() in one: the coarsest level is that after all rounds.
Result<ProgressiveMesh> build_progressive(const Mesh& mesh, const SimplifyOptions& options, Progress& progress);

}  // namespace lightwell
