// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lightwell/light/grid.h"

namespace lightwell {

/// The 3D texture of three.js's LightProbeGrid (0.187), RGBA half floats: seven sub-volumes stacked along z, each
/// nodes z + 2 slices deep, its first and last slice copies of the neighbouring data. Node (x, y, z) is the texel (x,
/// y, t (nz + 2) + 1 + z) of sub-volume t; the seven texels hold 28 channels: red, green, blue of nine spherical
/// harmonics (an exact linear map of the moments, in the order of three.js's formula), then one more. Two forms:
///
/// - plain, for any viewer with three.js's own lookup: the coefficients as they are; last channel 1.
/// - patched, for shaders/light_grid.glsl: all channels of the plain form times node_weight times scale, so that
///   dividing by the last one after filtering leaves invalid nodes out (docs/light.md section 5) and undoes the scale.
///   The lookup never filters the padding, so texel (0, 0, 0) carries what the chunk needs besides: the grid's cell /
///   its longest side (red, green, blue) and the normal offset in cells (alpha); texel (1, 0, 0) is 0, for the page to
///   mark. Where the grid stands in the world comes through three.js's uniforms: light_grid.glsl says how.
enum class AtlasForm { plain, patched };

struct LightAtlas {
  /// A dark atlas for a grid. `scale`: see light_scale; the plain form does not use it.
  LightAtlas(const GridShape& shape, AtlasForm form, float normal_offset, float scale);

  /// The texels of one slice that a band of nodes touches: full rows y ... y + rows - 1 at depth `slice`.
  struct Rows {
    int y = 0;
    int rows = 0;
    int slice = 0;
    size_t first_half = 0;  ///< where they begin in halves; rows * width * 4 of them follow one another
  };
  /// Writes the nodes y ... y + rows - 1 of the layer z, all x, and returns what changed in the texture: seven pieces,
  /// one a sub-volume, and seven more of padding for the first and for the last layer.
  std::vector<Rows> update(const LightGrid& grid, int y, int rows, int z);
  /// Writes all nodes.
  void update(const LightGrid& grid);

  int width() const { return nodes[0]; }
  int height() const { return nodes[1]; }
  int depth() const { return 7 * (nodes[2] + 2); }

  Vec3i nodes;
  AtlasForm form;
  float scale;
  std::vector<uint16_t> halves;  ///< width * height * depth * 4, x fastest

 private:
  void write_header();
  std::array<uint16_t, 28> channels_of(const Moments& moments, bool valid) const;

  Vec4f header_;
};

/// The coefficients c0 ... c8 of three.js's irradiance formula (its constants to six digits) for the same irradiance as
/// the moments at every unit normal.
std::array<Vec3f, 9> spherical_harmonics(const Moments& moments);

}  // namespace lightwell
