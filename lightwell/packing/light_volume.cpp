// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/light_volume.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightwell {
namespace {

template <typename Irradiance>
std::array<Vec3f, 6> axis_moments(const Irradiance& irradiance) {
  std::array<Vec3f, 6> moments;
  for (int axis = 0; axis < 3; axis++) {
    Vec3f direction{};
    direction[axis] = 1;
    moments[static_cast<size_t>(2 * axis)] = irradiance(direction);
    moments[static_cast<size_t>(2 * axis + 1)] = irradiance(-direction);
  }
  return moments;
}

// S of two axes, from the irradiance E(n) = (F.n + (M_a + M_b + S) / 2) / 2 of a direction n between them
// (docs/light.md section 2), or with -S between one and the opposite of the other. Of the four such directions the
// brightest is none whose irradiance would be negative, which the lookup takes for 0.
template <typename Irradiance>
Vec3f mixed_moment(const Irradiance& irradiance, const std::array<Vec3f, 6>& e, int a, int b) {
  const auto facing = [&](int axis) { return e[static_cast<size_t>(2 * axis)]; };
  const auto away = [&](int axis) { return e[static_cast<size_t>(2 * axis + 1)]; };
  Vec3f brightest{}, mixed{};
  for (const float on_a : {1.0f, -1.0f})
    for (const float on_b : {1.0f, -1.0f}) {
      Vec3f direction{};
      direction[a] = on_a * std::sqrt(0.5f);
      direction[b] = on_b * std::sqrt(0.5f);
      const Vec3f found = irradiance(direction);
      const Vec3f flux = (facing(a) - away(a)) * direction[a] + (facing(b) - away(b)) * direction[b];
      const Vec3f s = found * 4 - flux * 2 - (facing(a) + away(a) + facing(b) + away(b));
      for (int channel = 0; channel < 3; channel++) {
        if (found[channel] <= brightest[channel]) continue;
        brightest[channel] = found[channel];
        mixed[channel] = on_a * on_b * s[channel];
      }
    }
  return mixed;
}

Moments moments_at(const LightField& field, const Vec3f& point) {
  const auto irradiance = [&](const Vec3f& direction) { return field.irradiance(point, Vec3f{}, direction); };
  const std::array<Vec3f, 6> e = axis_moments(irradiance);
  Moments moments;
  std::copy(e.begin(), e.end(), moments.m.begin());
  moments.m[6] = mixed_moment(irradiance, e, 0, 1);
  moments.m[7] = mixed_moment(irradiance, e, 0, 2);
  moments.m[8] = mixed_moment(irradiance, e, 1, 2);
  return moments;
}

}  // namespace

LightVolume sample_volume(const LightField& field, const GridShape& shape, const Vec3d& origin) {
  LightVolume volume{shape, origin, {}};
  volume.nodes.reserve(shape.count());
  for (size_t i = 0; i < shape.count(); i++) volume.nodes.push_back(moments_at(field, shape.position(shape.node(i))));
  return volume;
}

}  // namespace lightwell
