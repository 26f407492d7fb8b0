// SPDX-License-Identifier: Apache-2.0
//
// The records of the papers, which give the three colours of an irradiance vector one direction d, the mean of theirs,
// in signed bytes. S08: with the irradiance of each colour, so that it is right for the axis direction itself, as
// RGB9E5. R09: with the length of each colour's vector, as half floats.
#include <algorithm>
#include <cmath>

#include "lightwell/base/half.h"
#include "lightwell/light/irradiance_vectors.h"
#include "lightwell/light/lattice_record.h"
#include "lightwell/light/record.h"

namespace lightwell {
namespace {

/// Numbers of a direction, and their models.
constexpr size_t direction_numbers = 3;
constexpr uint8_t direction_models = 3, exponent_models = 6;

Vec3f axis_direction(size_t d) {
  Vec3f direction{};
  direction[static_cast<int>(d / 2)] = d % 2 == 0 ? 1.0f : -1.0f;
  return direction;
}

Vec3f decode_direction(std::span<const int32_t> numbers) {
  const Vec3f sum{{static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])}};
  const float square = dot(sum, sum);
  return square > 0 ? sum / std::sqrt(square) : Vec3f{};
}

class DirectionRecord : public LatticeRecord {
 protected:
  using LatticeRecord::LatticeRecord;

  void add_direction() {
    for (size_t a = 0; a < direction_numbers; a++)
      numbers_.push_back({.least = -direction_end,
                          .most = direction_end,
                          .models = static_cast<uint8_t>(direction_models + a),
                          .begins = a == 0});
  }
};

class DirectionColourRecord final : public DirectionRecord {
 public:
  explicit DirectionColourRecord(float scale) : DirectionRecord(LightRecord::direction_colour, scale) {
    for (size_t d = 0; d < 6; d++) {
      add_direction();
      const auto exponent = static_cast<uint8_t>(numbers_.size());
      numbers_.push_back({.least = 0,
                          .most = 31,
                          .models = exponent_models,
                          .begins = true,
                          .expected = RecordNumber::Expected::largest});
      add_colour(
          {.least = 0, .most = 511, .models = 0, .expected = RecordNumber::Expected::scaled, .exponent = exponent},
          RecordNumber::Colour::follows_in_proportion);
    }
  }

  Moments decode(std::span<const int32_t> numbers) const override {
    IrradianceVectors vectors;
    for (size_t d = 0, i = 0; d < 6; d++) {
      const Vec3f direction = decode_direction(numbers.subspan(i, direction_numbers));
      i += direction_numbers;
      uint32_t bits = static_cast<uint32_t>(numbers[i++]) << 27;
      for (const int c : coded_colours) bits |= static_cast<uint32_t>(numbers[i++]) << (9 * c);
      // A vector across its own axis is no encoder's; it counts as one along it.
      const float along = dot(direction, axis_direction(d));
      const Vec3f likeness = along > 1.0f / direction_end ? direction / along : axis_direction(d);
      const Vec3f colours = decode_rgb9e5(bits) * (1 / scale_);
      for (int c = 0; c < 3; c++) vectors.v[d][static_cast<size_t>(c)] = likeness * colours[c];
    }
    return moments_of(vectors);
  }
};

class DirectionMagnitudeRecord final : public DirectionRecord {
 public:
  explicit DirectionMagnitudeRecord(float scale) : DirectionRecord(LightRecord::direction_magnitude, scale) {
    for (size_t d = 0; d < 6; d++) {
      add_direction();
      add_colour({.least = 0, .most = largest_half, .models = 0, .begins = true}, RecordNumber::Colour::follows);
    }
  }

  Moments decode(std::span<const int32_t> numbers) const override {
    IrradianceVectors vectors;
    for (size_t d = 0, i = 0; d < 6; d++) {
      const Vec3f direction = decode_direction(numbers.subspan(i, direction_numbers));
      i += direction_numbers;
      for (const int c : coded_colours)
        vectors.v[d][static_cast<size_t>(c)] = direction * (from_half(static_cast<uint16_t>(numbers[i++])) / scale_);
    }
    return moments_of(vectors);
  }
};

}  // namespace

std::unique_ptr<const LatticeRecord> direction_colour_record(float scale) {
  return std::make_unique<DirectionColourRecord>(scale);
}

std::unique_ptr<const LatticeRecord> direction_magnitude_record(float scale) {
  return std::make_unique<DirectionMagnitudeRecord>(scale);
}

}  // namespace lightwell
