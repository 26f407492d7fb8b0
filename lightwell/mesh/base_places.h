// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/mesh/stream.h"

namespace lightwell {

/// The places of a coarsest level's arrays in the opening, in bytes from the start of the BIN chunk's data; the arrays
/// are ordinary glTF accessors, tightly packed. Follows the MeshLayout in a mesh stream's parameters (docs/format.md).
struct BasePlaces {
  uint32_t positions = 0;               ///< 12 bytes a vertex
  uint32_t normals = 0;                 ///< 12 bytes a vertex; 0 when absent, like the next ones
  std::array<uint32_t, 2> texcoords{};  ///< 8 bytes a vertex
  uint32_t colors = 0;                  ///< 8 bytes a vertex
  uint32_t indices = 0;                 ///< of all regions, one behind the other
  bool short_indices = false;           ///< 2 bytes an index, else 4

  void write(ByteWriter& writer) const;
  static Result<BasePlaces> read(ByteReader& reader);
  /// Whether the places of the attributes that the layout does not have are 0.
  bool only_of(const MeshLayout& layout) const;
};

/// The parameters of a mesh stream (docs/format.md): all that is known before its first block.
struct MeshParameters {
  MeshLayout layout;
  BasePlaces places;

  /// Errors: those of the two parts, places of attributes that the layout does not have, and trailing bytes.
  static Result<MeshParameters> read(Bytes parameters, bool has_regions);
};

/// The arrays of a coarsest level, copied out of the opening.
struct BaseArrays {
  std::vector<Vec3f> positions, normals;
  std::array<std::vector<Vec2f>, 2> texcoords;
  std::vector<Color16> colors;
  std::vector<uint32_t> indices;

  MeshArrays view() const { return {positions, normals, {texcoords[0], texcoords[1]}, colors, indices}; }

  /// Reads the arrays that the layout asks for from the BIN chunk's data. Fails when an array lies outside it.
  static Result<BaseArrays> read(const MeshLayout& layout, const BasePlaces& places, Bytes bin);
};

}  // namespace lightwell
