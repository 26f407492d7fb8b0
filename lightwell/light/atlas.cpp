// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/atlas.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/base/half.h"

namespace lightwell {
namespace {

constexpr int sub_volumes = 7;
constexpr float smallest_normal_half = 0x1p-14f;

// The constants of three.js's formula.
constexpr float band0 = 0.886227f;
constexpr float band1 = 2 * 0.511664f;
constexpr float band2 = 2 * 0.429043f;       // xy, yz, xz
constexpr float zonal_square = 0.743125f;    // of z^2
constexpr float zonal_constant = 0.247708f;  // subtracted
constexpr float difference = 0.429043f;      // of x^2 - y^2

/// Where the parts of an atlas with bricks lie.
struct BrickLayout {
  BrickLayout(const GridShape& shape, const BrickTree& tree) {
    const auto round_up = [](int value, int step) { return (value + step - 1) / step; };
    for (int a = 0; a < 3; a++) {
      coarse[a] = round_up(shape.cells()[a], Brick::cells);
      indirection[a] = round_up(shape.cells()[a] << tree.levels(), Brick::cells);
    }
    const auto count = static_cast<int>(node_count(coarse) + tree.bricks().size());
    // About as wide as high as a sub-volume is deep, and wide enough for the indirection.
    int side = 1;
    while (side * side * side < count) side++;
    bricks[0] = std::max(side, round_up(indirection[0], Brick::side));
    bricks[1] = std::max(side, round_up(indirection[1], Brick::side));
    bricks[2] = round_up(count, bricks[0] * bricks[1]);
    size = {
        {Brick::side * bricks[0], Brick::side * bricks[1], 1 + indirection[2] + sub_volumes * Brick::side * bricks[2]}};
  }

  Vec3i coarse;       // bricks of level 0 on each axis
  Vec3i indirection;  // cubes on each axis
  Vec3i bricks;       // of a sub-volume, on each axis
  Vec3i size;         // texels
};

}  // namespace

// On the unit sphere a x^2 + b y^2 + c z^2 = (a+b)/2 + (c - (a+b)/2) z^2 + (a-b)/2 (x^2 - y^2).
std::array<Vec3f, 9> spherical_harmonics(const Moments& moments) {
  std::array<Vec3f, 9> harmonics;
  for (int c = 0; c < 3; c++) {
    const auto m = [&](size_t i) { return moments.m[i][c]; };
    const auto linear = [&](size_t axis) { return (m(2 * axis) - m(2 * axis + 1)) * (0.5f / band1); };
    const auto square = [&](size_t axis) { return (m(2 * axis) + m(2 * axis + 1)) * 0.5f; };
    const float x = square(0), y = square(1), level = (x + y) * 0.5f, zonal = (square(2) - level) / zonal_square;
    const std::array<float, 9> colour{(level + zonal * zonal_constant) / band0,
                                      linear(1),
                                      linear(2),
                                      linear(0),
                                      m(6) * (0.5f / band2),
                                      m(8) * (0.5f / band2),
                                      zonal,
                                      m(7) * (0.5f / band2),
                                      (x - y) * (0.5f / difference)};
    for (size_t i = 0; i < 9; i++) harmonics[i][c] = colour[i];
  }
  return harmonics;
}

LightAtlas::LightAtlas(const GridShape& shape, float normal_offset, float scale, const BrickTree& tree)
    : shape_(shape), scale_(scale), normal_offset_(normal_offset), levels_(tree.levels()) {
  if (levels_ == 0) {
    sub_volume_ = shape.nodes[2] + 2;
    size_ = {{shape.nodes[0], shape.nodes[1], sub_volumes * sub_volume_}};
  } else {
    const BrickLayout layout(shape, tree);
    coarse_ = layout.coarse;
    indirection_ = layout.indirection;
    bricks_on_axis_ = layout.bricks;
    sub_volume_ = Brick::side * layout.bricks[2];
    first_slice_ = 1 + layout.indirection[2];
    size_ = layout.size;
  }
  halves_.resize(4 * node_count(size_));
  write_header();
}

uint64_t LightAtlas::texels(const GridShape& shape, const BrickTree& tree) {
  if (tree.empty())
    return shape.count() / static_cast<size_t>(shape.nodes[2]) * sub_volumes * static_cast<size_t>(shape.nodes[2] + 2);
  return node_count(BrickLayout(shape, tree).size);
}

void LightAtlas::write_header() {
  const auto write = [&](int texel, const Vec4f& value) {
    std::array<uint16_t, 4> halves;
    for (int lane = 0; lane < 4; lane++) halves[static_cast<size_t>(lane)] = to_half(value[lane]);
    write_texel({{texel, 0, 0}}, halves.data());
  };
  const Vec3f ratio = shape_.cell / max_component(shape_.cell);
  write(0, {{ratio[0], ratio[1], ratio[2], normal_offset_}});
  if (levels_ == 0) return write(1, {});
  write(1, {{0, float(levels_), float(sub_volume_), float(first_slice_)}});
  const Vec3f cells = shape_.cells().cast<float>();
  write(2, {{cells[0], cells[1], cells[2], 0}});
}

void LightAtlas::update(const LightGrid& grid) {
  LW_ASSERT(grid.shape.nodes == shape_.nodes);
  if (levels_ == 0)
    update_regular(grid);
  else
    update_bricks(grid);
}

void LightAtlas::update_regular(const LightGrid& grid) {
  const int last = shape_.nodes[2] - 1;
  for (size_t i = 0; i < grid.moments.size(); i++) {
    const Channels channels = channels_of(grid.moments[i], node_weight(grid.valid[i]));
    const Vec3i n = shape_.node(i);
    for (int t = 0; t < sub_volumes; t++) {
      const uint16_t* four = &channels[static_cast<size_t>(4 * t)];
      const Vec3i texel = n + Vec3i{{0, 0, t * sub_volume_ + 1}};
      write_texel(texel, four);
      if (n[2] == 0) write_texel(texel - Vec3i{{0, 0, 1}}, four);
      if (n[2] == last) write_texel(texel + Vec3i{{0, 0, 1}}, four);
    }
  }
  write_header();
}

void LightAtlas::update_bricks(const LightGrid& grid) {
  size_t number = 0;
  Vec3i at;
  for (at[2] = 0; at[2] < coarse_[2]; at[2]++)
    for (at[1] = 0; at[1] < coarse_[1]; at[1]++)
      for (at[0] = 0; at[0] < coarse_[0]; at[0]++) {
        const Vec3i first = first_texel(number++);
        for (int point = 0; point < Brick::points; point++) {
          // What reaches out of the grid is never looked up.
          const Vec3i n = min(at * Brick::cells + Brick::local(point), shape_.cells());
          const size_t node = shape_.index(n);
          write_node(first + Brick::local(point), channels_of(grid.moments[node], node_weight(grid.valid[node])));
        }
      }
  for (const BrickPoints& points : grid.bricks) {
    const Vec3i first = first_texel(number++);
    for (int point = 0; point < Brick::points; point++) {
      const BrickPoint& light = points[static_cast<size_t>(point)];
      write_node(first + Brick::local(point), channels_of(light.moments, light.weight));
    }
  }
  write_indirection(grid);
}

void LightAtlas::write_indirection(const LightGrid& grid) {
  const size_t coarse = node_count(coarse_);
  const float cells_a_cube = std::ldexp(float(Brick::cells), -levels_);
  Vec3i cube;
  for (cube[2] = 0; cube[2] < indirection_[2]; cube[2]++)
    for (cube[1] = 0; cube[1] < indirection_[1]; cube[1]++)
      for (cube[0] = 0; cube[0] < indirection_[0]; cube[0]++) {
        const auto brick = grid.tree.finest((cube.cast<float>() + Vec3f::filled(0.5f)) * cells_a_cube);
        const Vec3i coarse_at{{cube[0] >> levels_, cube[1] >> levels_, cube[2] >> levels_}};
        const Vec3i first = first_texel(brick ? coarse + *brick : node_index(coarse_, coarse_at));
        const int level = brick ? grid.tree.bricks()[*brick].level : 0;
        const std::array<uint16_t, 4> halves{to_half(float(first[0])), to_half(float(first[1])),
                                             to_half(float(first[2])), to_half(float(level))};
        write_texel(cube + Vec3i{{0, 0, 1}}, halves.data());
      }
}

Vec3i LightAtlas::first_texel(size_t brick) const {
  const auto n = static_cast<int>(brick);
  return Vec3i{{n % bricks_on_axis_[0], n / bricks_on_axis_[0] % bricks_on_axis_[1],
                n / (bricks_on_axis_[0] * bricks_on_axis_[1])}} *
         Brick::side;
}

void LightAtlas::write_node(const Vec3i& at, const Channels& channels) {
  for (int t = 0; t < sub_volumes; t++)
    write_texel(at + Vec3i{{0, 0, first_slice_ + t * sub_volume_}}, &channels[static_cast<size_t>(4 * t)]);
}

void LightAtlas::write_texel(const Vec3i& at, const uint16_t* channels) {
  std::copy_n(channels, 4, halves_.begin() + static_cast<ptrdiff_t>(4 * node_index(size_, at)));
}

LightAtlas::Channels LightAtlas::channels_of(const Moments& moments, float node_weight) const {
  const float weight = std::max(node_weight * scale_, smallest_normal_half);
  const std::array<Vec3f, 9> coefficients = spherical_harmonics(moments);
  Channels channels;
  for (size_t c = 0; c < 27; c++) channels[c] = to_half(coefficients[c / 3][static_cast<int>(c % 3)] * weight);
  channels[27] = to_half(weight);
  return channels;
}

}  // namespace lightwell
