// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/lattice_record.h"

namespace lightwell {

void LatticeRecord::add_colour(RecordNumber number, RecordNumber::Colour follows) {
  const uint8_t models = number.models;
  for (const int c : coded_colours) {
    number.colour = c == coded_colours.front() ? RecordNumber::Colour::leads : follows;
    number.models = static_cast<uint8_t>(models + c);
    numbers_.push_back(number);
    number.begins = false;
  }
}

std::unique_ptr<const LatticeRecord> make_lattice_record(LightRecord record, int steps, float scale) {
  switch (record) {
    case LightRecord::shared_exponent: return shared_exponent_record(scale);
    case LightRecord::floats: return floats_record(scale);
    case LightRecord::direction_colour: return direction_colour_record(scale);
    case LightRecord::direction_magnitude: return direction_magnitude_record(scale);
    case LightRecord::moments: break;
  }
  return moments_record(steps, scale);
}

}  // namespace lightwell
