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
/// harmonics (an exact linear map of the moments, in the order of three.js's formula), then 1, all of them times
/// node_weight times scale. So dividing by the last one after filtering leaves invalid nodes out (docs/light.md section
/// 5) and undoes the scale. The product is at least 2^-14, the smallest normal half: a GPU that takes smaller ones for
/// zero would divide zero by zero inside solids. That is more than 2^-13 of a valid node's where the scale is below
/// 1/2.
///
/// shaders/light_grid.glsl never filters the padding, so texel (0, 0, 0) carries what it needs besides: the grid's cell
/// / its longest side (red, green, blue) and the normal offset in cells (alpha); texel (1, 0, 0) is 0, for the page to
/// mark. Where the grid stands in the world comes through three.js's uniforms.
struct LightAtlas {
  /// A dark atlas for a grid. `scale`: see light_scale.
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

/// The coefficients c0 ... c8 of three.js's irradiance formula (its constants to six digits) for the same irradiance as
/// the moments at every unit normal.
std::array<Vec3f, 9> spherical_harmonics(const Moments& moments);

}  // namespace lightwell
