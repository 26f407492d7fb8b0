// SPDX-License-Identifier: Apache-2.0
//
// The record LightRecord::floats: the bits of the 27 moments as floats, in the order of their values. What is smaller
// than 2^-20 of a scaled unit, a 2^-30th of the largest E, is 0.
#include <algorithm>
#include <bit>
#include <cmath>

#include "lightwell/light/lattice_record.h"

namespace lightwell {
namespace {

constexpr int32_t below = std::bit_cast<int32_t>(smallest_float) - 1;
constexpr int32_t end = std::bit_cast<int32_t>(largest_float) - below;

float value_of(int32_t number) {
  if (number == 0) return 0;
  const float size = std::bit_cast<float>(std::abs(number) + below);
  return number < 0 ? -size : size;
}

class FloatsRecord final : public LatticeRecord {
 public:
  explicit FloatsRecord(float scale) : LatticeRecord(LightRecord::floats, scale) {
    for (size_t i = 0; i < 9; i++) {
      const bool mixed = i >= 6;
      add_colour({.least = mixed ? -end : 0,
                  .most = end,
                  .models = static_cast<uint8_t>(mixed ? 3 : 0),
                  .begins = i == 0 || i == 6},
                 RecordNumber::Colour::follows);
    }
  }

  Moments decode(std::span<const int32_t> numbers) const override {
    Moments moments;
    for (size_t i = 0; i < 27; i++) moments.m[i / 3][coded_colours[i % 3]] = value_of(numbers[i]) / scale_;
    return moments;
  }
};

}  // namespace

std::unique_ptr<const LatticeRecord> floats_record(float scale) { return std::make_unique<FloatsRecord>(scale); }

}  // namespace lightwell
