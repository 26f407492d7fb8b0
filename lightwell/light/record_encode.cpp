// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include "lightwell/base/half.h"
#include "lightwell/light/irradiance_vectors.h"
#include "lightwell/light/lattice_record.h"
#include "lightwell/light/record.h"

namespace lightwell {
namespace {

void encode_moments(const LatticeRecord& record, const Moments& moments, std::span<int32_t> numbers) {
  // S goes as far as one step for each of a whole share.
  const std::span<const RecordNumber> table = record.numbers();
  const auto steps = static_cast<float>(table.back().most);
  Moments decoded;
  for (size_t i = 0; i < table.size(); i++) {
    const size_t entry = i / 3;
    const int c = coded_colours[i % 3];
    float wanted;
    if (entry < 6) {
      wanted = std::log2(std::max(moments.m[entry][c] * record.scale(), 0.0f) + moments_darkness);
    } else {
      if (i == 18) decoded = record.decode(numbers);
      const float bound = mixed_bound(decoded, entry - 6)[c];
      wanted = bound > 0 ? std::clamp(moments.m[entry][c] / bound, -1.0f, 1.0f) : 0.0f;
    }
    numbers[i] = std::clamp(static_cast<int32_t>(std::lround(steps * wanted)), table[i].least, table[i].most);
  }
}

void put_rgb9e5(uint32_t bits, std::span<int32_t> numbers) {
  numbers[0] = static_cast<int32_t>(bits >> 27);
  for (size_t i = 0; i < 3; i++) numbers[i + 1] = static_cast<int32_t>(bits >> (9 * coded_colours[i]) & 511);
}

void encode_shared_exponent(const LatticeRecord& record, const Moments& moments, std::span<int32_t> numbers) {
  const MomentsRecord found = encode_record(moments * record.scale(), true);
  for (size_t d = 0; d < 6; d++) put_rgb9e5(found.irradiance[d], numbers.subspan(4 * d, 4));
  for (size_t i = 0; i < 9; i++) numbers[24 + i] = found.mixed[3 * (i / 3) + static_cast<size_t>(coded_colours[i % 3])];
}

void encode_floats(const LatticeRecord& record, const Moments& moments, std::span<int32_t> numbers) {
  constexpr int32_t below = std::bit_cast<int32_t>(smallest_float) - 1;
  for (size_t i = 0; i < record.numbers().size(); i++) {
    const float value = moments.m[i / 3][coded_colours[i % 3]] * record.scale();
    const float size = std::min(std::abs(value), largest_float);
    const int32_t number = size >= smallest_float ? std::bit_cast<int32_t>(size) - below : 0;
    numbers[i] = std::max(value < 0 ? -number : number, record.numbers()[i].least);
  }
}

/// The direction of the three colours together.
void encode_direction(const std::array<Vec3f, 3>& colours, std::span<int32_t> numbers) {
  const Vec3f sum = colours[0] + colours[1] + colours[2];
  const float length = std::sqrt(dot(sum, sum));
  for (int a = 0; a < 3; a++)
    numbers[static_cast<size_t>(a)] =
        length > 0 ? static_cast<int32_t>(std::lround(sum[a] / length * direction_end)) : 0;
}

void encode_direction_colour(const LatticeRecord& record, const Moments& moments, std::span<int32_t> numbers) {
  const IrradianceVectors vectors = vectors_of(moments);
  for (size_t d = 0; d < 6; d++) {
    encode_direction(vectors.v[d], numbers.subspan(7 * d, 3));
    put_rgb9e5(encode_rgb9e5(moments.m[d] * record.scale()), numbers.subspan(7 * d + 3, 4));
  }
}

void encode_direction_magnitude(const LatticeRecord& record, const Moments& moments, std::span<int32_t> numbers) {
  const IrradianceVectors vectors = vectors_of(moments);
  for (size_t d = 0; d < 6; d++) {
    encode_direction(vectors.v[d], numbers.subspan(6 * d, 3));
    for (size_t i = 0; i < 3; i++) {
      const Vec3f& vector = vectors.v[d][static_cast<size_t>(coded_colours[i])];
      numbers[6 * d + 3 + i] =
          std::min<int32_t>(to_half(std::sqrt(dot(vector, vector)) * record.scale()), largest_half);
    }
  }
}

}  // namespace

void encode_numbers(const LatticeRecord& record, const Moments& moments, std::span<int32_t> numbers) {
  switch (record.kind()) {
    case LightRecord::moments: return encode_moments(record, moments, numbers);
    case LightRecord::shared_exponent: return encode_shared_exponent(record, moments, numbers);
    case LightRecord::floats: return encode_floats(record, moments, numbers);
    case LightRecord::direction_colour: return encode_direction_colour(record, moments, numbers);
    case LightRecord::direction_magnitude: return encode_direction_magnitude(record, moments, numbers);
  }
}

}  // namespace lightwell
