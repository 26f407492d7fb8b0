// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/record.h"

#include <gtest/gtest.h>

#include "tests/light/light_fields.h"

namespace lightwell {
namespace {

// Any float, negative, tiny and huge ones included.
float any_float(Random& random) { return std::bit_cast<float>(random.bits()); }

MomentsRecord any_record(Random& random) {
  MomentsRecord record;
  for (uint32_t& e : record.irradiance) e = random.bits();
  for (int8_t& s : record.mixed) s = static_cast<int8_t>(random.bits());
  return record;
}

// Half a step of nine bits at the largest channel: 2^-9 of the power of two above it, 2^-25 at least.
TEST(Rgb9e5, RoundsToTheNearest) {
  Random random(1, 0);
  for (int i = 0; i < 20000; i++) {
    const float size = std::exp2(40 * random.uniform() - 25);
    const Vec3f rgb = random_colour(random) * size;
    if (max_component(rgb) > 65408) continue;
    const Vec3f back = decode_rgb9e5(encode_rgb9e5(rgb));
    const float step = std::max(0x1p-24f, std::exp2(std::floor(std::log2(max_component(back))) - 8));
    for (int c = 0; c < 3; c++) EXPECT_LE(std::abs(back[c] - rgb[c]), 0.5f * step) << size;
  }
}

TEST(Rgb9e5, KnowsItsLimits) {
  EXPECT_EQ(decode_rgb9e5(encode_rgb9e5({{1e30f, 1, std::numeric_limits<float>::infinity()}}))[0], 65408);
  EXPECT_EQ(encode_rgb9e5({{-1, std::numeric_limits<float>::quiet_NaN(), -0.0f}}), 0u);
  EXPECT_EQ(decode_rgb9e5(encode_rgb9e5({{1, 0.5f, 0.25f}})), (Vec3f{{1, 0.5f, 0.25f}}));
  // 511.6 of 512: the mantissa overflows into the next exponent.
  EXPECT_EQ(decode_rgb9e5(encode_rgb9e5({{511.6f, 0, 0}}))[0], 512);
}

TEST(Rgb9e5, DecodedNumbersEncodeToThemselves) {
  Random random(2, 0);
  for (int i = 0; i < 20000; i++) {
    const Vec3f value = decode_rgb9e5(random.bits());
    EXPECT_EQ(decode_rgb9e5(encode_rgb9e5(value)), value);
    const uint32_t bits = encode_rgb9e5({{any_float(random), any_float(random), any_float(random)}});
    EXPECT_EQ(encode_rgb9e5(decode_rgb9e5(bits)), bits);
  }
}

TEST(MomentsRecord, EncodesToItself) {
  Random random(3, 0);
  for (int i = 0; i < 5000; i++) {
    const MomentsRecord first = any_record(random);
    const Moments moments = decode_record(first);
    for (const Vec3f& m : moments.m) ASSERT_TRUE(is_finite(m));
    const MomentsRecord record = encode_record(moments, first.valid());
    EXPECT_EQ(record.valid(), first.valid());
    EXPECT_EQ(encode_record(decode_record(record), record.valid()), record);
    // Bounds of zero hide S, and the mark of invalid nodes one more: what is left decodes the same.
    EXPECT_EQ(decode_record(record).m, moments.m);
  }
}

TEST(MomentsRecord, IsThirtyThreeBytes) {
  Random random(4, 0);
  const MomentsRecord record = any_record(random);
  ByteWriter writer;
  record.write(writer);
  EXPECT_EQ(writer.size(), MomentsRecord::bytes);
  ByteReader reader(writer.bytes());
  EXPECT_EQ(MomentsRecord::read(reader), record);
}

TEST(MomentsRecord, MarksInvalidNodes) {
  const Moments m = parallel_light(normalized(Vec3f{{1, 2, 3}}), {{5, 6, 7}});
  EXPECT_TRUE(encode_record(m, true).valid());
  EXPECT_FALSE(encode_record(m, false).valid());
  EXPECT_EQ(decode_record(encode_record(m, false)).m[0], decode_record(encode_record(m, true)).m[0]);
}

// S is off by half of 1/127 of its bound, plus what rounding of E does to the bound (2^-9 of it).
TEST(MomentsRecord, NeverClipsS) {
  Random random(5, 0);
  for (int i = 0; i < 5000; i++) {
    const Moments m = parallel_light(random_direction(random), Vec3f::filled(std::exp2(20 * random.uniform() - 5)));
    const Moments back = decode_record(encode_record(m, true));
    for (size_t pair = 0; pair < 3; pair++) {
      const size_t a = pair == 2 ? 1 : 0, b = pair == 0 ? 1 : 2;
      const float bound = 0.5f * (m.m[2 * a] + m.m[2 * a + 1] + m.m[2 * b] + m.m[2 * b + 1])[0];
      EXPECT_LE(std::abs(back.m[6 + pair][0] - m.m[6 + pair][0]), bound * (0.5f / 127 + 0x1p-8f));
    }
  }
}

// The design's figure for rooms is 0.13-0.14 %; small lamps make larger S than a room's diffuse light does.
TEST(MomentsRecord, AddsLittleError) {
  Random random(6, 0);
  const LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{4, 3, 5}}}, 12), 3);
  const float scale = light_scale(grid);
  double error = 0, truth = 0;
  for (const Moments& m : grid.moments) {
    const Moments back = decode_record(encode_record(m * scale, true)) * (1 / scale);
    for (int k = 0; k < 48; k++) {
      const Vec3f n = random_direction(random), difference = back.irradiance(n) - m.irradiance(n);
      error += dot(difference, difference);
      truth += dot(m.irradiance(n), m.irradiance(n));
    }
  }
  const double relative = std::sqrt(error / truth);
  RecordProperty("relative_rms_percent", std::to_string(100 * relative));
  EXPECT_LT(relative, 0.002);
}

TEST(LightScale, BringsTheLargestToATenthPower) {
  LightGrid grid = lamp_grid(GridShape{}, 1);
  const auto largest = [&] {
    float value = 0;
    for (const Moments& m : grid.moments) {
      for (size_t d = 0; d < 6; d++) value = std::max(value, max_component(m.m[d]));
    }
    return value;
  };
  for (const float size : {0.05f, 1.0f, 123.0f, 1e5f}) {
    for (Moments& m : grid.moments) m = m * (size / largest());
    EXPECT_GT(largest() * light_scale(grid), 512);
    EXPECT_LE(largest() * light_scale(grid), 1024);
  }
  grid.moments[0].m[0][0] = 1e38f;
  EXPECT_EQ(light_scale(grid), 0x1p-11f);
  for (Moments& m : grid.moments) m = {};
  EXPECT_EQ(light_scale(grid), 1);
}

}  // namespace
}  // namespace lightwell
