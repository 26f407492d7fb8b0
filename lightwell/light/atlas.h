// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lightwell/light/grid.h"

namespace lightwell {

/// The 3D texture of three.js's LightProbeGrid (0.187), RGBA half floats: seven sub-volumes stacked along z, each nz +
/// 2 slices deep for nz nodes, whose first and last slices repeat the adjacent ones. Node (x, y, z) is the texel (x, y,
/// t (nz + 2) + 1 + z) of sub-volume t. Its seven texels hold 28 channels: red, green, blue of nine spherical harmonics
/// (an exact linear map of the moments, in the order of three.js's formula), then 1, all multiplied by node_weight and
/// scale. Dividing by the last channel after filtering thus leaves invalid nodes out (docs/light.md section 5) and
/// undoes the scale. The factor is at least 2^-14, the smallest normal half: a GPU that flushes smaller ones to zero
/// would divide zero by zero inside solids. Where the scale is below 1/2, that is more than 2^-13 of a valid node's
/// factor.
///
/// shaders/light_grid.glsl never filters the padding, so texel (0, 0, 0) holds the other values it needs: the cell
/// divided by its longest side (red, green, blue) and the normal offset in cells (alpha). Texel (1, 0, 0) is 0; the
/// page sets its red for grids that hold the light of the environment. The grid's place in the world is passed in
/// three.js's uniforms.
struct LightAtlas {
  /// The atlas of a dark grid. `scale`: see light_scale.
  LightAtlas(const GridShape& shape, float normal_offset, float scale);

  /// Writes all nodes.
  void update(const LightGrid& grid);

  int width() const { return nodes[0]; }
  int height() const { return nodes[1]; }
  int depth() const { return 7 * (nodes[2] + 2); }

  Vec3i nodes;
  float scale;
  std::vector<uint16_t> halves;  ///< width * height * depth * 4, x fastest

 private:
  void write_header();
  std::array<uint16_t, 28> channels_of(const Moments& moments, bool valid) const;

  Vec4f header_;
};

/// The coefficients c0 ... c8 of three.js's irradiance formula (its constants to six digits) that give the same
/// irradiance as the moments for every unit normal.
std::array<Vec3f, 9> spherical_harmonics(const Moments& moments);

}  // namespace lightwell
