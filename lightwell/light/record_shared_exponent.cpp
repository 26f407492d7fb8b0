// SPDX-License-Identifier: Apache-2.0
//
// The record LightRecord::shared_exponent: what light/record.h writes in 33 bytes, number by number and without loss:
// for each E an exponent and three mantissas, then nine signed bytes for S.
#include "lightwell/light/lattice_record.h"
#include "lightwell/light/record.h"

namespace lightwell {
namespace {

class SharedExponentRecord final : public LatticeRecord {
 public:
  explicit SharedExponentRecord(float scale) : LatticeRecord(LightRecord::shared_exponent, scale) {
    for (size_t d = 0; d < 6; d++) {
      const auto exponent = static_cast<uint8_t>(numbers_.size());
      numbers_.push_back(
          {.least = 0, .most = 31, .models = 6, .begins = d == 0, .expected = RecordNumber::Expected::largest});
      add_colour(
          {.least = 0, .most = 511, .models = 0, .expected = RecordNumber::Expected::scaled, .exponent = exponent},
          RecordNumber::Colour::follows_in_proportion);
    }
    for (size_t pair = 0; pair < 3; pair++)
      add_colour({.least = -127, .most = 127, .models = 3, .begins = pair == 0}, RecordNumber::Colour::follows);
  }

  Moments decode(std::span<const int32_t> numbers) const override {
    MomentsRecord record;
    size_t i = 0;
    for (uint32_t& bits : record.irradiance) {
      bits = static_cast<uint32_t>(numbers[i++]) << 27;
      for (const int c : coded_colours) bits |= static_cast<uint32_t>(numbers[i++]) << (9 * c);
    }
    for (size_t pair = 0; pair < 3; pair++)
      for (const int c : coded_colours)
        record.mixed[3 * pair + static_cast<size_t>(c)] = static_cast<int8_t>(numbers[i++]);
    return decode_record(record) * (1 / scale_);
  }
};

}  // namespace

std::unique_ptr<const LatticeRecord> shared_exponent_record(float scale) {
  return std::make_unique<SharedExponentRecord>(scale);
}

}  // namespace lightwell
