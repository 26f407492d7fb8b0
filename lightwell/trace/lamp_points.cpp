// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lamp_points.h"

#include <cmath>
#include <numbers>

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

constexpr uint32_t shift = 0x55555555;

/// The index's bits, the lowest first: van der Corput's sequence, Sobol's first dimension.
uint32_t first_dimension(uint32_t index) {
  uint32_t bits = 0;
  for (uint32_t bit = uint32_t(1) << 31; index > 0; index >>= 1, bit >>= 1)
    if (index & 1) bits |= bit;
  return bits;
}

uint32_t second_dimension(uint32_t index) {
  uint32_t bits = 0;
  for (uint32_t row = uint32_t(1) << 31; index > 0; index >>= 1, row ^= row >> 1)
    if (index & 1) bits ^= row;
  return bits;
}

/// Takes a square round the origin to a disc so that areas keep their ratios (P. Shirley, K. Chiu, A Low Distortion Map
/// Between Disk and Square, 1997).
Vec2f disc_of(float x, float y) {
  if (x == 0 && y == 0) return {};
  const bool is_wide = std::abs(x) > std::abs(y);
  const float angle = std::numbers::pi_v<float> / 4 * (is_wide ? y / x : 2 - x / y);
  const float radius = is_wide ? x : y;
  return {{radius * std::cos(angle), radius * std::sin(angle)}};
}

/// A point of a disc, turned as the page has it.
Vec3f point_of_disc(const ClientLamp& lamp, const Vec2f& place) {
  const Vec2f at = disc_of(2 * place[0] - 1, 2 * place[1] - 1) * lamp.radius;
  const Vec3f aside = std::abs(lamp.normal[0]) < 0.5f ? Vec3f{{1, 0, 0}} : Vec3f{{0, 1, 0}};
  const Vec3f right = normalized(cross(aside, lamp.normal));
  return lamp.center + right * at[0] + cross(lamp.normal, right) * at[1];
}

}  // namespace

Vec2f progressive_point(uint32_t index) {
  const auto fraction = [](uint32_t bits) { return static_cast<float>(bits ^ shift) * 0x1p-32f; };
  return {{fraction(first_dimension(index)), fraction(second_dimension(index))}};
}

LampPoint lamp_point(const ClientLamp& lamp, uint32_t index) {
  const Vec2f place = progressive_point(index);
  if (lamp.kind == ClientLamp::Kind::rectangle)
    return {lamp.center + lamp.half_u * (2 * place[0] - 1) + lamp.half_v * (2 * place[1] - 1), lamp.normal};
  if (lamp.kind == ClientLamp::Kind::disc) return {point_of_disc(lamp, place), lamp.normal};
  LW_ASSERT(lamp.kind == ClientLamp::Kind::sphere);
  const float z = 1 - 2 * place[0], turn = 2 * std::numbers::pi_v<float> * place[1];
  const float across = std::sqrt(std::max(0.0f, 1 - z * z));
  const Vec3f normal{{across * std::cos(turn), across * std::sin(turn), z}};
  return {lamp.center + normal * lamp.radius, normal};
}

}  // namespace lightwell
