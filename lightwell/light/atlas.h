// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
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
/// divided by its longest side (red, green, blue) and the normal offset in cells (alpha). Of texel (1, 0, 0) red is 0;
/// the page sets it for grids that hold the light of the environment. The grid's place in the world is passed in
/// three.js's uniforms.
///
/// A grid with bricks has another layout. Slice 0 holds the header: after the two texels the number of the grid's cells
/// (2, 0, 0). Green of texel (1, 0, 0) is the finest level, blue the depth of a sub-volume and alpha the slice of the
/// first. The slices before that are the indirection: the texel (x, y, 1 + z) tells of the cube (x, y, z) of the finest
/// level's brick size in which brick it lies: the brick's first texel in a sub-volume (red, green, blue), and its level
/// (alpha). Bricks are 5 x 5 x 5 texels; the grid's own cells are cut into bricks of level 0. Without bricks green of
/// texel (1, 0, 0) is 0.
class LightAtlas {
 public:
  /// The atlas of a dark grid, with room for the bricks of `tree`. `scale`: see light_scale.
  LightAtlas(const GridShape& shape, float normal_offset, float scale, const BrickTree& tree = {});

  /// Writes all nodes. The grid's bricks are the first ones of the constructor's tree.
  void update(const LightGrid& grid);

  int width() const { return size_[0]; }
  int height() const { return size_[1]; }
  int depth() const { return size_[2]; }

  /// width * height * depth * 4, x fastest.
  std::span<const uint16_t> halves() const { return halves_; }

  /// The texels of an atlas with room for so many bricks.
  static uint64_t texels(const GridShape& shape, const BrickTree& tree);

 private:
  using Channels = std::array<uint16_t, 28>;

  void write_header();
  void update_regular(const LightGrid& grid);
  void update_bricks(const LightGrid& grid);
  void write_indirection(const LightGrid& grid);
  Vec3i first_texel(size_t brick) const;
  Channels channels_of(const Moments& moments, float weight) const;
  void write_texel(const Vec3i& at, const uint16_t* channels);
  void write_node(const Vec3i& at, const Channels& channels);

  GridShape shape_;
  float scale_;
  float normal_offset_;
  int levels_;              // of bricks; 0 in a regular grid
  Vec3i size_;              // texels
  Vec3i coarse_{};          // bricks of level 0 on each axis
  Vec3i indirection_{};     // cubes on each axis
  int sub_volume_ = 0;      // slices from one sub-volume to the next
  int first_slice_ = 1;     // of the first sub-volume
  Vec3i bricks_on_axis_{};  // of a sub-volume
  std::vector<uint16_t> halves_;
};

/// The coefficients c0 ... c8 of three.js's irradiance formula (its constants to six digits) that give the same
/// irradiance as the moments for every unit normal.
std::array<Vec3f, 9> spherical_harmonics(const Moments& moments);

}  // namespace lightwell
