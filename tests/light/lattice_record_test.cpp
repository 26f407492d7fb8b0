// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/lattice_record.h"

#include <gtest/gtest.h>

#include "lightwell/light/irradiance_vectors.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/record.h"
#include "tests/light/brick_fields.h"
#include "tests/light/stream_parts.h"

namespace lightwell {
namespace {

constexpr LightRecord all_records[] = {LightRecord::moments, LightRecord::shared_exponent, LightRecord::floats,
                                       LightRecord::direction_colour, LightRecord::direction_magnitude};

/// Uniform and parallel light of any colours.
Moments random_light(Random& random) {
  Moments m = uniform_light(random_colour(random) * 30);
  for (int i = 0; i < 3; i++) m += parallel_light(random_direction(random), random_colour(random) * 100);
  return m;
}

Moments through(const LatticeRecord& record, const Moments& moments) {
  std::vector<int32_t> numbers(record.numbers().size());
  encode_numbers(record, moments, numbers);
  return record.decode(numbers);
}

void expect_near(const Moments& a, const Moments& b, float relative) {
  float largest = 0;
  for (const Vec3f& v : b.m) largest = std::max(largest, max_component(max(v, v * -1)));
  for (size_t i = 0; i < a.m.size(); i++)
    for (int c = 0; c < 3; c++) EXPECT_NEAR(a.m[i][c], b.m[i][c], relative * largest) << i << " " << c;
}

TEST(IrradianceVectors, HaveTheMomentsTheyAreOf) {
  Random random(1, 0);
  for (int i = 0; i < 100; i++) {
    const Moments m = random_light(random);
    expect_near(moments_of(vectors_of(m)), m, 1e-6f);
  }
}

// The vectors of the halves that it comes from are the light itself, the others 0.
TEST(IrradianceVectors, OfParallelLightAreItself) {
  Random random(2, 0);
  for (int i = 0; i < 100; i++) {
    const Vec3f direction = random_direction(random);
    const IrradianceVectors vectors = vectors_of(parallel_light(direction, Vec3f::filled(2)));
    for (size_t a = 0; a < 3; a++) {
      const size_t lit = 2 * a + (direction[static_cast<int>(a)] < 0), dark = 4 * a + 1 - lit;
      for (int b = 0; b < 3; b++) {
        EXPECT_NEAR(vectors.v[lit][0][b], 2 * direction[b], 1e-5f);
        EXPECT_NEAR(vectors.v[dark][0][b], 0, 1e-5f);
      }
    }
  }
}

// A step of 1/32 of an octave rounds by at most 1.1 %, evenly: 0.63 % in root mean square, and what is added to E so
// that its logarithm ends makes more of it in the dark only.
TEST(LatticeRecord, OfMomentsRoundsToHalfAStep) {
  Random random(3, 0);
  const auto record = make_lattice_record(LightRecord::moments, 32, 1);
  for (int i = 0; i < 300; i++) {
    const Moments m = random_light(random), back = through(*record, m);
    for (size_t d = 0; d < 6; d++)
      for (int c = 0; c < 3; c++) EXPECT_NEAR(back.m[d][c], m.m[d][c], 0.0112f * (m.m[d][c] + 0.0625f));
  }
}

TEST(LatticeRecord, OfSharedExponentsIsTheRecordOfSlices) {
  Random random(4, 0);
  const auto record = make_lattice_record(LightRecord::shared_exponent, 32, 4);
  for (int i = 0; i < 300; i++) {
    const Moments m = random_light(random);
    const Moments slices = decode_record(encode_record(m * 4, true)) * 0.25f, back = through(*record, m);
    for (size_t k = 0; k < 9; k++) EXPECT_EQ(back.m[k], slices.m[k]);
  }
}

TEST(LatticeRecord, OfFloatsIsExact) {
  Random random(5, 0);
  const auto record = make_lattice_record(LightRecord::floats, 32, 0.5f);
  for (int i = 0; i < 300; i++) {
    const Moments m = random_light(random), back = through(*record, m);
    for (size_t k = 0; k < 9; k++) EXPECT_EQ(back.m[k], m.m[k]);
  }
}

// Bytes of a direction tell it to half a degree, 0.4 % and a few times that across axes; RGB9E5 tells E to 0.2 %.
TEST(LatticeRecord, OfDirectionsKeepsGreyLight) {
  Random random(6, 0);
  const auto colour = make_lattice_record(LightRecord::direction_colour, 32, 1);
  const auto magnitude = make_lattice_record(LightRecord::direction_magnitude, 32, 1);
  for (int i = 0; i < 300; i++) {
    Moments m = uniform_light(Vec3f::filled(30 * random.uniform()));
    for (int k = 0; k < 3; k++) m += parallel_light(random_direction(random), Vec3f::filled(100 * random.uniform()));
    expect_near(through(*colour, m), m, 0.02f);
    expect_near(through(*magnitude, m), m, 0.02f);
  }
}

// What three colours with one direction lose. S08's record keeps E of the axes, R09's loses of that too: 2 to 10 % of a
// light of three colours from three sides, where grey light keeps to a percent.
TEST(LatticeRecord, OfDirectionsLosesColours) {
  const auto error = [](LightRecord kind, bool grey) {
    Random random(8, 0);
    const auto record = make_lattice_record(kind, 32, 1);
    double difference = 0, size = 0;
    for (int i = 0; i < 300; i++) {
      Moments m;
      for (int c = 0; c < 3; c++) {
        Vec3f colour = Vec3f::filled(grey ? 10.0f : 0.0f);
        colour[c] = 10;
        m += parallel_light(random_direction(random), colour);
      }
      const Moments back = through(*record, m);
      for (size_t d = 0; d < 6; d++)
        for (int c = 0; c < 3; c++) {
          difference += static_cast<double>(std::abs(back.m[d][c] - m.m[d][c]));
          size += static_cast<double>(m.m[d][c]);
        }
      const Vec3f normal = random_direction(random);
      const Vec3f a = back.irradiance(normal), b = m.irradiance(normal);
      for (int c = 0; c < 3; c++) {
        difference += static_cast<double>(std::abs(a[c] - b[c]));
        size += static_cast<double>(b[c]);
      }
    }
    return difference / size;
  };
  EXPECT_LT(error(LightRecord::direction_colour, true), 0.01);
  EXPECT_LT(error(LightRecord::direction_magnitude, true), 0.01);
  EXPECT_GT(error(LightRecord::direction_colour, false), 0.02);
  EXPECT_GT(error(LightRecord::direction_magnitude, false), 2 * error(LightRecord::direction_colour, false));
}

TEST(LatticeRecord, AnyNumbersAreFinite) {
  Random random(7, 0);
  for (const LightRecord kind : all_records) {
    for (const int steps : {least_steps, 32, most_steps}) {
      const auto record = make_lattice_record(kind, steps, 0x1p15f);
      std::vector<int32_t> numbers(record->numbers().size());
      ASSERT_LE(numbers.size(), LatticeRecord::most_numbers);
      for (int i = 0; i < 300; i++) {
        for (size_t k = 0; k < numbers.size(); k++) {
          const RecordNumber& number = record->numbers()[k];
          numbers[k] = std::clamp(static_cast<int32_t>(random.bits()), number.least, number.most);
        }
        for (const Vec3f& m : record->decode(numbers).m) EXPECT_TRUE(is_finite(m));
      }
    }
  }
}

// The stream loses nothing of what a record has.
TEST(LatticeStream, ReturnsEveryRecord) {
  for (const LightRecord kind : all_records) {
    const LightGrid grid = bricked_grid(3, 10);
    const LatticeStream stream = encode_lattice(grid, {.record = kind}).value();
    LatticeDecoder decoder = std::move(LatticeDecoder::open(parameters(stream.layout), stream_bytes(stream)).value());
    EXPECT_EQ(decoder.layout().record, kind);
    for (const LightBundle& bundle : stream.bundles) ASSERT_TRUE(decoder.append(bundle.payload));
    ASSERT_TRUE(decoder.complete());
    const LightGrid back = decoder.grid(Fill::none);
    const auto record = stream.layout.make_record();
    for (size_t i = 0; i < grid.moments.size(); i++) {
      if (!grid.valid[i]) continue;
      const Moments wanted = through(*record, grid.moments[i]);
      for (size_t k = 0; k < 9; k++) ASSERT_EQ(back.moments[i].m[k], wanted.m[k]) << static_cast<int>(kind);
    }
    const BrickNodes nodes(grid.tree);
    for (const BrickNode& node : nodes.nodes()) {
      const BrickPoint& point = grid.bricks[node.brick][static_cast<size_t>(node.point)];
      if (point.weight <= node_weight(false)) continue;
      const Moments wanted = through(*record, point.moments);
      for (size_t k = 0; k < 9; k++)
        ASSERT_EQ(back.bricks[node.brick][static_cast<size_t>(node.point)].moments.m[k], wanted.m[k]);
    }
  }
}

}  // namespace
}  // namespace lightwell
