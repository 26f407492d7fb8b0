// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/ply_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace lightwell {
namespace {

// No number is written with more characters.
constexpr size_t longest_word = 512;

bool is_space(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

double PlyValues::number(PlyType type) {
  const double value = format_ == PlyFormat::ascii ? next_word() : binary_number(type);
  return ok() ? value : 0;
}

size_t PlyValues::list_length(const PlyProperty& list) {
  const double length = number(list.count_type);
  const size_t least_size = format_ == PlyFormat::ascii ? 2 : size_of(list.type);
  const double most = static_cast<double>(reader_.remaining() + 1) / static_cast<double>(least_size);
  if (!(length >= 0 && length <= most && length == std::floor(length))) ok_ = false;
  return ok() ? static_cast<size_t>(length) : 0;
}

void PlyValues::skip(const PlyProperty& property) {
  const size_t count = property.is_list ? list_length(property) : 1;
  for (size_t i = 0; i < count && ok(); i++) number(property.type);
}

double PlyValues::binary_number(PlyType type) {
  const Bytes field = reader_.take(size_of(type));
  uint64_t bits = 0;
  for (size_t i = 0; i < field.size(); i++) {
    const size_t place = format_ == PlyFormat::little_endian ? i : field.size() - 1 - i;
    bits |= uint64_t(field[i]) << (8 * place);
  }
  switch (type) {
    case PlyType::int8: return static_cast<int8_t>(bits);
    case PlyType::uint8: return static_cast<uint8_t>(bits);
    case PlyType::int16: return static_cast<int16_t>(bits);
    case PlyType::uint16: return static_cast<uint16_t>(bits);
    case PlyType::int32: return static_cast<int32_t>(bits);
    case PlyType::uint32: return static_cast<uint32_t>(bits);
    case PlyType::float32: return std::bit_cast<float>(static_cast<uint32_t>(bits));
    case PlyType::float64: return std::bit_cast<double>(bits);
  }
  return 0;
}

double PlyValues::next_word() {
  char word[longest_word];
  size_t length = 0;
  while (reader_.remaining() > 0 && length < longest_word) {
    const uint8_t c = reader_.u8();
    if (!is_space(c)) {
      word[length++] = static_cast<char>(c);
    } else if (length > 0) {
      break;
    }
  }
  const char* start = length > 0 && word[0] == '+' ? word + 1 : word;
  double value = 0;
  const auto [end, error] = std::from_chars(start, word + length, value);
  if (length == 0 || error != std::errc() || end != word + length) ok_ = false;
  return value;
}

}  // namespace lightwell
