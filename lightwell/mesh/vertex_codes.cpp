// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/vertex_codes.h"

#include <bit>
#include <cmath>

namespace lightwell {
namespace {

constexpr int grid = 511;  // steps from the centre of the octahedral square to its edge

template <typename T>
T with_sign_of(T magnitude, T sign) {
  return sign < 0 ? -magnitude : magnitude;
}

// Folds the lower half of the octahedron out over the corners of the square (or back: the map is its own inverse).
template <typename T>
void fold(T& u, T& v, T one) {
  const T old = u;
  u = with_sign_of<T>(one - std::abs(v), u);
  v = with_sign_of<T>(one - std::abs(old), v);
}

// On the rim of the square two points are one direction: the one with the positive coordinate stands for both.
NormalCode canonical(int u, int v) {
  if (std::abs(u) == grid) v = std::abs(v);
  if (std::abs(v) == grid) u = std::abs(u);
  return {static_cast<int16_t>(u), static_cast<int16_t>(v)};
}

constexpr NormalCode up{0, grid};

}  // namespace

int32_t Lattice::code(float value) const {
  if (!std::isfinite(value)) return 0;
  const double steps = std::floor(static_cast<double>(value) * power_of_two(-exponent) + 0.5);
  return static_cast<int32_t>(std::clamp<double>(steps, -limit, limit));
}

NormalCode normal_code(const Vec3f& n) {
  const Vec3d d = n.cast<double>();
  const double size = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
  if (!(size > 0) || !std::isfinite(size)) return up;
  double u = d[0] / size, v = d[1] / size;
  if (d[2] < 0) fold(u, v, 1.0);
  return canonical(static_cast<int>(std::floor(u * grid + 0.5)), static_cast<int>(std::floor(v * grid + 0.5)));
}

NormalCode normal_code(const Vec<int64_t, 3>& n) {
  int64_t size = std::abs(n[0]) / 4 + std::abs(n[1]) / 4 + std::abs(n[2]) / 4;
  const int shift = std::max(0, static_cast<int>(std::bit_width(static_cast<uint64_t>(size))) - 48);
  const int64_t x = n[0] / (int64_t(1) << shift), y = n[1] / (int64_t(1) << shift), z = n[2] / (int64_t(1) << shift);
  size = std::abs(x) + std::abs(y) + std::abs(z);
  if (size == 0) return up;
  int64_t u = x * grid / size, v = y * grid / size;
  if (z < 0) fold<int64_t>(u, v, grid);
  return canonical(static_cast<int>(u), static_cast<int>(v));
}

Vec3f normal_of(NormalCode code) {
  double x = double(code.u) / grid, y = double(code.v) / grid;
  const double z = 1 - std::abs(x) - std::abs(y);
  if (z < 0) fold(x, y, 1.0);
  return normalized(Vec3d{{x, y, z}}).cast<float>();
}

ColorCode color_code(const Vec4f& color) {
  Color16 nearest{};
  for (int i = 0; i < 4; i++)
    if (color[i] > 0)
      nearest[static_cast<size_t>(i)] = static_cast<uint16_t>(std::min(color[i], 1.0f) * 65535.0f + 0.5f);
  return color_code(nearest);
}

ColorCode color_code(const Color16& color) {
  ColorCode code;
  for (size_t i = 0; i < 3; i++)
    code[i] = static_cast<uint8_t>(std::sqrt(static_cast<float>(color[i]) / 65535.0f) * 255.0f + 0.5f);
  code[3] = static_cast<uint8_t>((color[3] + 128u) / 257);
  return code;
}

Color16 color_value(const ColorCode& code) {
  constexpr uint32_t one = 255 * 255;
  Color16 value{};
  for (size_t i = 0; i < 3; i++)
    value[i] = static_cast<uint16_t>((uint32_t(code[i]) * code[i] * 65535 + one / 2) / one);
  value[3] = static_cast<uint16_t>(code[3] * 257);
  return value;
}

}  // namespace lightwell
