// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lightwell/base/result.h"
#include "lightwell/mesh/mesh.h"
#include "lightwell/mesh/vertex_codes.h"

namespace lightwell {

struct QuantizeOptions {
  /// Largest deviation of a coordinate, in the mesh's units. 0: codes of 14 bits for the longest side of the bounding
  /// box, which deviate by at most a 16,384th of it. At least 6 bits are used, so that a mesh smaller than the
  /// deviation keeps its form; at most 21, and no more than the floats of the input hold.
  float position_error = 0;
  /// Of each vertex the row of what goes with it beside the mesh (a skin's weights). Vertices of different rows stay
  /// apart. Empty: none has anything.
  std::span<const uint32_t> rows = {};
  /// Of each vertex the region of the mesh that its faces belong to (a primitive of its own, with its own material),
  /// and of each region its position_error. Empty: one region.
  std::span<const uint16_t> regions = {};
  std::span<const float> region_errors = {};
};

/// The position_error that stands for the default of a mesh whose bounding box has that longest side.
float usual_position_error(float side);

/// A mesh in integers: positions and texcoords on lattices, normals on the octahedral grid, colours in 8 bits. Its
/// vertices are the distinct tuples that faces use; all faces of the input are kept, also degenerate and repeated ones.
/// Absent attributes are empty.
struct QuantizedMesh {
  Lattice position_lattice;
  std::array<Lattice, 2> texcoord_lattices;
  std::vector<Vec3i> positions;
  std::vector<NormalCode> normals;
  std::array<std::vector<Vec<int, 2>>, 2> texcoords;
  std::vector<ColorCode> colors;
  std::vector<uint32_t> rows;  ///< as in QuantizeOptions
  std::vector<Face> faces;
  std::vector<uint16_t> regions;       ///< of each face; empty: one region
  std::vector<uint8_t> region_shifts;  ///< positions of a region are multiples of 2^shift steps of the lattice

  /// Whether vertices of different regions stay apart: where they have attributes that only their material gives a
  /// meaning.
  bool has_regions_apart() const {
    return !regions.empty() && !(texcoords[0].empty() && texcoords[1].empty() && colors.empty());
  }
};

/// Quantises a mesh whose indices are in range. The vertices are in Morton order of their positions, those of one
/// position next to each other. Errors: a position that a face uses is not finite or beyond 1e37.
Result<QuantizedMesh> quantize(const Mesh& mesh, const QuantizeOptions& options);

/// The mesh that the codes stand for.
Mesh dequantize(const QuantizedMesh& mesh);

}  // namespace lightwell
