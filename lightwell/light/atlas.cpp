// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/atlas.h"

#include <algorithm>

#include "lightwell/base/assert.h"
#include "lightwell/base/half.h"

namespace lightwell {
namespace {

constexpr int sub_volumes = 7;

// The constants of three.js's formula.
constexpr float band0 = 0.886227f;
constexpr float band1 = 2 * 0.511664f;
constexpr float band2 = 2 * 0.429043f;       // xy, yz, xz
constexpr float zonal_square = 0.743125f;    // of z^2
constexpr float zonal_constant = 0.247708f;  // taken away
constexpr float difference = 0.429043f;      // of x^2 - y^2

}  // namespace

// On the unit sphere a x^2 + b y^2 + c z^2 = (a+b)/2 + (c - (a+b)/2) z^2 + (a-b)/2 (x^2 - y^2).
std::array<Vec3f, 9> spherical_harmonics(const Moments& moments) {
  const std::array<Vec3f, 9>& m = moments.m;
  const auto linear = [&](size_t axis) { return (m[2 * axis] - m[2 * axis + 1]) * (0.5f / band1); };
  const auto square = [&](size_t axis) { return (m[2 * axis] + m[2 * axis + 1]) * 0.5f; };
  const Vec3f level = (square(0) + square(1)) * 0.5f;
  const Vec3f zonal = (square(2) - level) / zonal_square;
  return {(level + zonal * zonal_constant) / band0,
          linear(1),
          linear(2),
          linear(0),
          m[6] * (0.5f / band2),
          m[8] * (0.5f / band2),
          zonal,
          m[7] * (0.5f / band2),
          (square(0) - square(1)) * (0.5f / difference)};
}

LightAtlas::LightAtlas(const GridShape& shape, AtlasForm atlas_form, float normal_offset, float light_scale)
    : nodes(shape.nodes), form(atlas_form), scale(light_scale) {
  halves.resize(shape.count() / static_cast<size_t>(nodes[2]) * static_cast<size_t>(depth()) * 4);
  const Vec3f ratio = shape.cell / max_component(shape.cell);
  header_ = {{ratio[0], ratio[1], ratio[2], normal_offset}};
  write_header();
}

void LightAtlas::write_header() {
  if (form != AtlasForm::patched) return;
  for (int lane = 0; lane < 4; lane++) halves[static_cast<size_t>(lane)] = to_half(header_[lane]);
  std::fill_n(halves.begin() + 4, 4, uint16_t(0));
}

std::vector<LightAtlas::Rows> LightAtlas::update(const LightGrid& grid, int y, int rows, int z) {
  LW_ASSERT(grid.shape.nodes == nodes && y >= 0 && rows >= 0 && y + rows <= nodes[1] && z >= 0 && z < nodes[2]);
  std::vector<Rows> touched;
  for (int t = 0; t < sub_volumes; t++) {
    const int data = t * (nodes[2] + 2) + 1 + z;
    touched.push_back({y, rows, data, 0});
    if (z == 0) touched.push_back({y, rows, data - 1, 0});
    if (z == nodes[2] - 1) touched.push_back({y, rows, data + 1, 0});
  }
  const size_t row = static_cast<size_t>(nodes[0]) * 4;
  for (Rows& piece : touched) {
    piece.first_half =
        (static_cast<size_t>(piece.slice) * static_cast<size_t>(nodes[1]) + static_cast<size_t>(y)) * row;
  }
  const size_t first_node = grid.shape.index({{0, y, z}});
  const size_t count = static_cast<size_t>(rows) * static_cast<size_t>(nodes[0]);
  for (size_t i = 0; i < count; i++) {
    const std::array<uint16_t, 28> texels = channels_of(grid.moments[first_node + i], grid.valid[first_node + i]);
    for (const Rows& piece : touched) {
      const auto sub_volume = static_cast<size_t>(piece.slice / (nodes[2] + 2));
      for (size_t lane = 0; lane < 4; lane++) halves[piece.first_half + i * 4 + lane] = texels[sub_volume * 4 + lane];
    }
  }
  write_header();
  return touched;
}

void LightAtlas::update(const LightGrid& grid) {
  for (int z = 0; z < nodes[2]; z++) update(grid, 0, nodes[1], z);
}

std::array<uint16_t, 28> LightAtlas::channels_of(const Moments& moments, bool valid) const {
  const float weight = form == AtlasForm::patched ? node_weight(valid) * scale : 1.0f;
  const std::array<Vec3f, 9> coefficients = spherical_harmonics(moments);
  std::array<uint16_t, 28> halves_of_node;
  for (size_t c = 0; c < 27; c++) halves_of_node[c] = to_half(coefficients[c / 3][static_cast<int>(c % 3)] * weight);
  halves_of_node[27] = to_half(weight);
  return halves_of_node;
}

}  // namespace lightwell
