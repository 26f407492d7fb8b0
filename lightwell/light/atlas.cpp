// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/atlas.h"

#include <algorithm>

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

LightAtlas::LightAtlas(const GridShape& shape, float normal_offset, float light_scale)
    : nodes(shape.nodes), scale(light_scale) {
  halves.resize(shape.count() / static_cast<size_t>(nodes[2]) * static_cast<size_t>(depth()) * 4);
  const Vec3f ratio = shape.cell / max_component(shape.cell);
  header_ = {{ratio[0], ratio[1], ratio[2], normal_offset}};
  write_header();
}

void LightAtlas::write_header() {
  for (int lane = 0; lane < 4; lane++) halves[static_cast<size_t>(lane)] = to_half(header_[lane]);
  std::fill_n(halves.begin() + 4, 4, uint16_t(0));
}

void LightAtlas::update(const LightGrid& grid) {
  LW_ASSERT(grid.shape.nodes == nodes);
  const size_t layer = static_cast<size_t>(nodes[0]) * static_cast<size_t>(nodes[1]);
  for (size_t i = 0; i < grid.moments.size(); i++) {
    const std::array<uint16_t, 28> channels = channels_of(grid.moments[i], grid.valid[i]);
    const auto z = static_cast<int>(i / layer);
    for (int t = 0; t < sub_volumes; t++) {
      const auto write = [&](int slice) {
        const size_t texel = static_cast<size_t>(slice) * layer + i % layer;
        std::copy_n(&channels[static_cast<size_t>(4 * t)], 4, &halves[4 * texel]);
      };
      const int slice = t * (nodes[2] + 2) + 1 + z;
      write(slice);
      if (z == 0) write(slice - 1);
      if (z == nodes[2] - 1) write(slice + 1);
    }
  }
  write_header();
}

std::array<uint16_t, 28> LightAtlas::channels_of(const Moments& moments, bool valid) const {
  const float weight = std::max(node_weight(valid) * scale, smallest_normal_half);
  const std::array<Vec3f, 9> coefficients = spherical_harmonics(moments);
  std::array<uint16_t, 28> channels;
  for (size_t c = 0; c < 27; c++) channels[c] = to_half(coefficients[c / 3][static_cast<int>(c % 3)] * weight);
  channels[27] = to_half(weight);
  return channels;
}

}  // namespace lightwell
