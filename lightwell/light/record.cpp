// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/record.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lightwell/base/power_of_two.h"

namespace lightwell {
namespace {

constexpr int mantissa_limit = 511;
constexpr int largest_exponent = 31;
// A mantissa m with exponent e stands for m * 2^(e - 24).
constexpr int exponent_bias = 24;
constexpr float largest_rgb9e5 = 65408;  // 511 * 2^(31 - 24)

float representable(float value) { return value > 0 ? std::min(value, largest_rgb9e5) : 0.0f; }

int mantissa(float value, int exponent) {
  // The product is exact, and in double precision so is the sum.
  return static_cast<int>(static_cast<double>(value * power_of_two(exponent_bias - exponent)) + 0.5);
}

// The axes a < b of the three pairs xy, xz, yz.
constexpr std::array<std::array<size_t, 2>, 3> axis_pairs{{{0, 1}, {0, 2}, {1, 2}}};

int8_t encode_share(float value, float bound) {
  const float share = bound > 0 ? value / bound : 0.0f;
  if (!(std::abs(share) <= 1)) return share > 1 ? 127 : share < -1 ? -127 : 0;
  return static_cast<int8_t>(std::floor(share * 127 + 0.5f));
}

}  // namespace

Vec3f mixed_bound(const Moments& moments, size_t pair) {
  const auto [a, b] = axis_pairs[pair];
  return (moments.m[2 * a] + moments.m[2 * a + 1] + moments.m[2 * b] + moments.m[2 * b + 1]) * 0.5f;
}

uint32_t encode_rgb9e5(const Vec3f& rgb) {
  const Vec3f value{{representable(rgb[0]), representable(rgb[1]), representable(rgb[2])}};
  const float largest = max_component(value);
  // The exponent field of a float gives the power of two of the largest number; its mantissa gets nine bits.
  const int power = static_cast<int>(std::bit_cast<uint32_t>(largest) >> 23) - 127;
  int exponent = std::clamp(power + 1 - 9 + exponent_bias, 0, largest_exponent);
  if (mantissa(largest, exponent) > mantissa_limit) exponent++;
  uint32_t bits = static_cast<uint32_t>(exponent) << 27;
  for (int c = 0; c < 3; c++) bits |= static_cast<uint32_t>(mantissa(value[c], exponent)) << (9 * c);
  return bits;
}

Vec3f decode_rgb9e5(uint32_t bits) {
  const float step = power_of_two(static_cast<int>(bits >> 27) - exponent_bias);
  return Vec3f{{static_cast<float>(bits & 511), static_cast<float>(bits >> 9 & 511),
                static_cast<float>(bits >> 18 & 511)}} *
         step;
}

void MomentsRecord::write(ByteWriter& writer) const {
  for (const uint32_t e : irradiance) writer.u32(e);
  for (const int8_t s : mixed) writer.u8(static_cast<uint8_t>(s));
}

MomentsRecord MomentsRecord::read(ByteReader& reader) {
  MomentsRecord record;
  for (uint32_t& e : record.irradiance) e = reader.u32();
  for (int8_t& s : record.mixed) s = static_cast<int8_t>(reader.u8());
  return record;
}

MomentsRecord encode_record(const Moments& moments, bool valid) {
  MomentsRecord record;
  Moments decoded;
  for (size_t d = 0; d < 6; d++) {
    record.irradiance[d] = encode_rgb9e5(moments.m[d]);
    decoded.m[d] = decode_rgb9e5(record.irradiance[d]);
  }
  for (size_t pair = 0; pair < 3; pair++) {
    const Vec3f bound = mixed_bound(decoded, pair);
    for (int c = 0; c < 3; c++) {
      record.mixed[3 * pair + static_cast<size_t>(c)] = encode_share(moments.m[6 + pair][c], bound[c]);
    }
  }
  if (!valid) record.mixed[0] = MomentsRecord::invalid_mark;
  return record;
}

Moments decode_record(const MomentsRecord& record) {
  Moments moments;
  for (size_t d = 0; d < 6; d++) moments.m[d] = decode_rgb9e5(record.irradiance[d]);
  for (size_t pair = 0; pair < 3; pair++) {
    const Vec3f bound = mixed_bound(moments, pair);
    for (int c = 0; c < 3; c++) {
      const size_t entry = 3 * pair + static_cast<size_t>(c);
      const bool marked = entry == 0 && !record.valid();
      const int share = marked ? 0 : std::max<int>(record.mixed[entry], -127);
      moments.m[6 + pair][c] = static_cast<float>(share) * bound[c] / 127;
    }
  }
  return moments;
}

float light_scale(const LightGrid& grid) {
  float largest = 0;
  for (const Moments& node : grid.moments) {
    for (size_t d = 0; d < 6; d++) largest = std::max(largest, max_component(node.m[d]));
  }
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  int power;  // largest = f * 2^power with f in [0.5, 1)
  const float fraction = std::frexp(largest, &power);
  if (fraction == 0.5f) power--;
  return power_of_two(std::clamp(10 - power, -11, 15));
}

}  // namespace lightwell
