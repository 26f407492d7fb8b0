// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/surface_cells.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// Of a cube's number on an axis: bits, and what is added so that it is not negative.
constexpr int axis_bits = 17;
constexpr int64_t axis_middle = int64_t(1) << (axis_bits - 1);
constexpr int64_t axis_end = int64_t(1) << axis_bits;
/// Of the level, the power of two by which a cube is larger; and of the way that it faces.
constexpr int level_bits = 5;
constexpr int facing_bits = 7;
constexpr int most_levels = 24;
static_assert(3 * axis_bits + level_bits + facing_bits <= 63);

/// Cubes grow from this many of their size outside of the region.
constexpr float near_cubes = 16;

/// Without a call of the C library's, which processors without SSE 4.1 would need: this runs for each ray.
int64_t round_down(float x) {
  const auto truncated = static_cast<int64_t>(x);
  return truncated - (static_cast<float>(truncated) > x);
}

/// A facing is rounded to halves on each axis, so that walls along the axes lie in the middle of their cell.
uint64_t facing_number(const Vec3f& facing) {
  uint64_t number = 0;
  for (int a = 0; a < 3; a++) number = number * 5 + static_cast<uint64_t>(2 * facing[a] + 2.5f);
  return number;
}

uint64_t pack(const std::array<int64_t, 3>& cube, uint64_t level, uint64_t facing) {
  uint64_t key = 1;
  for (const int64_t c : cube)
    key = key << axis_bits | static_cast<uint64_t>(std::clamp<int64_t>(c + axis_middle, 0, axis_end - 1));
  return (key << level_bits | level) << facing_bits | facing;
}

}  // namespace

uint64_t SurfaceCells::at(const Vec3f& position, const Vec3f& facing) const {
  const Vec3f outside = max(max(region_.lo - position, position - region_.hi), Vec3f{});
  const float distance = length(outside) / (near_cubes * size_);
  const int level = distance <= 1 ? 0 : std::min(most_levels, std::ilogb(distance) + 1);
  const float size = std::ldexp(size_, level);
  // A wall that lies where two cubes meet is moved into one of them, whatever rounding did to its points.
  const Vec3f inside = (position - region_.lo) / size + facing * 0.37f;
  std::array<int64_t, 3> cube;
  for (size_t a = 0; a < 3; a++) cube[a] = round_down(inside.e[a]);
  return pack(cube, static_cast<uint64_t>(level), facing_number(facing));
}

namespace {

/// A cell's cube, level and facing.
struct Parts {
  std::array<int64_t, 3> cube{};
  uint64_t level = 0, facing = 0;
};

Parts unpack(uint64_t cell) {
  Parts parts;
  parts.facing = cell & ((uint64_t(1) << facing_bits) - 1);
  parts.level = cell >> facing_bits & ((uint64_t(1) << level_bits) - 1);
  for (size_t a = 0; a < 3; a++) {
    const int shift = facing_bits + level_bits + axis_bits * static_cast<int>(2 - a);
    parts.cube[a] = static_cast<int64_t>(cell >> shift & static_cast<uint64_t>(axis_end - 1)) - axis_middle;
  }
  return parts;
}

}  // namespace

uint64_t SurfaceCells::parent(uint64_t cell) {
  Parts parts = unpack(cell);
  for (int64_t& number : parts.cube) number >>= 1;
  return pack(parts.cube, parts.level + 1, parts.facing);
}

uint64_t SurfaceCells::beside(uint64_t cell, const Vec3i& step) {
  Parts parts = unpack(cell);
  for (size_t a = 0; a < 3; a++) parts.cube[a] += step.e[a];
  return pack(parts.cube, parts.level, parts.facing);
}

}  // namespace lightwell
