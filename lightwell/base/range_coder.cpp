// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/range_coder.h"

#include <algorithm>

namespace lightwell {
namespace {

constexpr uint32_t smallest_range = 1u << 24;

uint32_t split(uint32_t range, const AdaptiveBit& context) { return (range >> 16) * context.probability_of_zero(); }

// Encodes the bits of value below its leading one: the first two adaptively, the others raw.
void encode_below_leading(RangeEncoder& encoder, std::array<AdaptiveBit, 4>& contexts, uint32_t value, int width) {
  int left = width - 1;
  uint32_t node = 1;
  for (int i = 0; i < 2 && left > 0; i++) {
    left--;
    const bool bit = value >> left & 1;
    encoder.bit(contexts[node & 3], bit);
    node = node << 1 | static_cast<uint32_t>(bit);
  }
  if (left > 0) encoder.raw(value & ((1u << left) - 1), left);
}

uint32_t decode_below_leading(RangeDecoder& decoder, std::array<AdaptiveBit, 4>& contexts, int width) {
  if (width == 0) return 0;
  int left = width - 1;
  uint32_t value = 1, node = 1;
  for (int i = 0; i < 2 && left > 0; i++) {
    left--;
    const auto bit = static_cast<uint32_t>(decoder.bit(contexts[node & 3]));
    node = node << 1 | bit;
    value = value << 1 | bit;
  }
  return left > 0 ? value << left | decoder.raw(left) : value;
}

}  // namespace

void RangeEncoder::bit(AdaptiveBit& context, bool value) {
  const uint32_t zero = split(range_, context);
  if (value) {
    low_ += zero;
    range_ -= zero;
  } else {
    range_ = zero;
  }
  context.learn(value);
  while (range_ < smallest_range) {
    range_ <<= 8;
    shift_low();
  }
}

void RangeEncoder::raw(uint32_t value, int count) {
  for (int left = count; left > 0;) {
    const int now = std::min(left, 16);
    left -= now;
    range_ >>= now;
    low_ += uint64_t(range_) * (value >> left & ((1u << now) - 1));
    while (range_ < smallest_range) {
      range_ <<= 8;
      shift_low();
    }
  }
}

std::vector<uint8_t> RangeEncoder::finish() {
  for (int i = 0; i < 5; i++) shift_low();
  // All four bytes of the last code word are kept: a decoder reads them, and would report overrun() without them.
  std::vector<uint8_t> bytes = std::move(bytes_);
  *this = RangeEncoder();
  return bytes;
}

// Writes a byte once no carry can reach it; a run of 0xff waits in pending_. The very first byte is always zero and is
// not written.
void RangeEncoder::shift_low() {
  if (low_ < 0xff000000u || low_ > 0xffffffffu) {
    const uint8_t carry = static_cast<uint8_t>(low_ >> 32);
    if (!first_) bytes_.push_back(static_cast<uint8_t>(cache_ + carry));
    first_ = false;
    for (; pending_ > 0; pending_--) bytes_.push_back(static_cast<uint8_t>(0xff + carry));
    cache_ = static_cast<uint8_t>(low_ >> 24);
  } else {
    pending_++;
  }
  low_ = (low_ & 0x00ffffffu) << 8;
}

RangeDecoder::RangeDecoder(Bytes bytes) : bytes_(bytes) {
  for (int i = 0; i < 4; i++) code_ = code_ << 8 | next_byte();
}

uint8_t RangeDecoder::next_byte() {
  if (at_ < bytes_.size()) return bytes_[at_++];
  overrun_ = true;
  return 0;
}

void RangeDecoder::normalize() {
  while (range_ < smallest_range) {
    range_ <<= 8;
    code_ = code_ << 8 | next_byte();
  }
}

bool RangeDecoder::bit(AdaptiveBit& context) {
  const uint32_t zero = split(range_, context);
  const bool value = code_ >= zero;
  if (value) {
    code_ -= zero;
    range_ -= zero;
  } else {
    range_ = zero;
  }
  context.learn(value);
  normalize();
  return value;
}

uint32_t RangeDecoder::raw(int count) {
  uint32_t value = 0;
  for (int left = count; left > 0;) {
    const int now = std::min(left, 16);
    left -= now;
    range_ >>= now;
    const uint32_t bits = std::min(code_ / range_, (1u << now) - 1);
    code_ -= bits * range_;
    value = value << now | bits;
    normalize();
  }
  return value;
}

void AdaptiveNatural::encode(RangeEncoder& encoder, uint32_t value) {
  const int width = std::bit_width(value);
  width_.encode(encoder, static_cast<uint32_t>(width));
  encode_below_leading(encoder, leading_[static_cast<size_t>(width)], value, width);
}

uint32_t AdaptiveNatural::decode(RangeDecoder& decoder) {
  const auto width = std::min<uint32_t>(width_.decode(decoder), 32);
  return decode_below_leading(decoder, leading_[width], static_cast<int>(width));
}

void AdaptiveInteger::encode(RangeEncoder& encoder, int32_t value) {
  const uint32_t magnitude = value < 0 ? 0u - static_cast<uint32_t>(value) : static_cast<uint32_t>(value);
  const auto width = static_cast<size_t>(std::bit_width(magnitude));
  width_.encode(encoder, static_cast<uint32_t>(width));
  if (width > 0) encoder.bit(sign_[width], value < 0);
  encode_below_leading(encoder, leading_[width], magnitude, static_cast<int>(width));
}

int32_t AdaptiveInteger::decode(RangeDecoder& decoder) {
  const auto width = std::min<uint32_t>(width_.decode(decoder), 32);
  const bool negative = width > 0 && decoder.bit(sign_[width]);
  const uint32_t magnitude = decode_below_leading(decoder, leading_[width], static_cast<int>(width));
  return static_cast<int32_t>(negative ? 0u - magnitude : magnitude);
}

void AdaptiveResidual::encode(RangeEncoder& encoder, int32_t value) {
  encoder.bit(zero_, value != 0);
  if (value == 0) return;
  encoder.bit(negative_, value < 0);
  const uint32_t magnitude = (value < 0 ? 0u - static_cast<uint32_t>(value) : static_cast<uint32_t>(value)) - 1;
  for (uint32_t i = 0; i < most_unary; i++) {
    encoder.bit(more_[i], magnitude > i);
    if (magnitude == i) return;
  }
  const uint32_t rest = magnitude - most_unary;  // at least 0, and rest + 1 has at most 32 bits
  const int width = std::bit_width(uint64_t(rest) + 1) - 1;
  encoder.raw(static_cast<uint32_t>(width), 5);
  encoder.raw(static_cast<uint32_t>(uint64_t(rest) + 1 - (uint64_t(1) << width)), width);
}

int32_t AdaptiveResidual::decode(RangeDecoder& decoder) {
  if (!decoder.bit(zero_)) return 0;
  const bool negative = decoder.bit(negative_);
  uint32_t magnitude = 0;
  while (magnitude < most_unary && decoder.bit(more_[magnitude])) magnitude++;
  if (magnitude == most_unary) {
    const int width = static_cast<int>(decoder.raw(5));
    magnitude += static_cast<uint32_t>((uint64_t(1) << width) - 1 + decoder.raw(width));
  }
  magnitude++;
  return static_cast<int32_t>(negative ? 0u - magnitude : magnitude);
}

}  // namespace lightwell
