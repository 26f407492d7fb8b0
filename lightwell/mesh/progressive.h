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
  /// Vertices that the coarsest level may have; it has fewer, by up to a third. What cannot be simplified so far stays.
  uint32_t base_vertices = 300;
};

/// A mesh with the order in which it collapses. Any of its levels can become the coarsest one of a progressive mesh.
struct SimplifiedMesh {
  /// The mesh as the first rounds leave it.
  struct Level {
    uint32_t vertices = 0, faces = 0;
    float error = 0;  ///< distance from the final level, in the mesh's units; an estimate
  };

  QuantizedMesh mesh;
  Points points;
  CollapseOrder order;

  /// Level i is what i rounds leave: the first is the whole mesh without loose faces.
  std::vector<Level> levels() const;
};

/// A mesh whose vertices are in order of refinement: those of the coarsest level, then pass by pass the ones that
/// splits add. The level of n vertices (n not inside a point) is the final mesh with every corner replaced by its
/// nearest ancestor below n, without the faces that then have two corners at one point. The progressive mesh of
/// H. Hoppe ("Progressive meshes", SIGGRAPH 1996, section 3); differs from the paper: a split moves no vertex, and
/// splits come in passes that do not depend on each other.
struct ProgressiveMesh {
  /// Splits that do not depend on each other: the points up to point_end.
  struct Pass {
    uint32_t point_end = 0;
    float error = 0;  ///< distance of the level before this pass from the final one, in the mesh's units; an estimate
  };

  /// The final level. Faces are in order of appearance; the loose ones (degenerate or repeated), which take no part in
  /// the refinement, come last.
  QuantizedMesh mesh;
  std::vector<uint32_t> parent;          ///< of each vertex: a smaller number; of one of the base: itself
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
/// three different corners. Errors: a position that is not finite; cancelled by the user. The mesh's indices must be in
/// range.
Result<SimplifiedMesh> simplify(const Mesh& mesh, const SimplifyOptions& options, Progress& progress);

/// The progressive mesh whose coarsest level is what `rounds` rounds leave.
ProgressiveMesh refine_after(SimplifiedMesh mesh, size_t rounds);

/// Both in one: the coarsest level is the last one.
Result<ProgressiveMesh> build_progressive(const Mesh& mesh, const SimplifyOptions& options, Progress& progress);

}  // namespace lightwell
