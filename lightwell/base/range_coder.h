// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lightwell/base/bytes.h"

namespace lightwell {

/// The probability that the next bit of one context is 0, learned from the bits seen there: the mean of a fast and a
/// slow state (rates 1/16 and 1/128), 16 bits each. Encoder and decoder keep equal copies; integers only, so that
/// native and WebAssembly agree to the bit.
class AdaptiveBit {
 public:
  /// Probability of a 0 in units of 2^-16, within [32, 65504].
  uint32_t probability_of_zero() const { return ((uint32_t(fast_) + slow_) >> 1) * 65472u / 65536u + 32u; }
  void learn(bool bit) {
    if (bit) {
      fast_ = static_cast<uint16_t>(fast_ - (fast_ >> 4));
      slow_ = static_cast<uint16_t>(slow_ - (slow_ >> 7));
    } else {
      fast_ = static_cast<uint16_t>(fast_ + ((65535 - fast_) >> 4));
      slow_ = static_cast<uint16_t>(slow_ + ((65535 - slow_) >> 7));
    }
  }

 private:
  uint16_t fast_ = 32768;
  uint16_t slow_ = 32768;
};

/// Binary range coder with carry propagation (Martin 1979, in the byte-wise form of LZMA) and a 32-bit range.
class RangeEncoder {
 public:
  void bit(AdaptiveBit& context, bool value);
  /// Encodes the low `count` bits of value with equal probabilities, most significant first; count <= 32.
  void raw(uint32_t value, int count);
  /// Ends the stream, returns its bytes and resets the encoder. The contexts are the caller's and keep their state.
  std::vector<uint8_t> finish();

 private:
  void shift_low();

  std::vector<uint8_t> bytes_;
  uint64_t low_ = 0;
  uint32_t range_ = 0xffffffffu;
  uint8_t cache_ = 0;
  uint64_t pending_ = 0;
  bool first_ = true;
};

/// Decodes what RangeEncoder wrote. Bytes beyond the end read as zero: any input decodes to something, in time bounded
/// by the number of calls, and overrun() tells whether it was too short.
class RangeDecoder {
 public:
  explicit RangeDecoder(Bytes bytes);

  bool bit(AdaptiveBit& context);
  uint32_t raw(int count);
  /// True when more bytes were needed than there were.
  bool overrun() const { return overrun_; }

 private:
  void normalize();
  uint8_t next_byte();

  Bytes bytes_;
  size_t at_ = 0;
  uint32_t range_ = 0xffffffffu;
  uint32_t code_ = 0;
  bool overrun_ = false;
};

/// An adaptive model of symbols of `Bits` bits: a binary tree of contexts, most significant bit first.
template <int Bits>
class AdaptiveSymbol {
 public:
  void encode(RangeEncoder& encoder, uint32_t symbol) {
    uint32_t node = 1;
    for (int i = Bits - 1; i >= 0; i--) {
      const bool bit = symbol >> i & 1;
      encoder.bit(tree_[node], bit);
      node = node << 1 | static_cast<uint32_t>(bit);
    }
  }
  uint32_t decode(RangeDecoder& decoder) {
    uint32_t node = 1;
    for (int i = 0; i < Bits; i++) node = node << 1 | static_cast<uint32_t>(decoder.bit(tree_[node]));
    return node - (1u << Bits);
  }

 private:
  std::array<AdaptiveBit, (size_t(1) << Bits)> tree_;
};

/// An adaptive model of signed 32-bit integers that are mostly small: the number of significant bits as a symbol, the
/// two bits below the leading one adaptive, the others raw, and an adaptive sign.
class AdaptiveInteger {
 public:
  void encode(RangeEncoder& encoder, int32_t value);
  int32_t decode(RangeDecoder& decoder);

 private:
  AdaptiveSymbol<6> width_;
  std::array<AdaptiveBit, 33> sign_;
  std::array<std::array<AdaptiveBit, 4>, 33> leading_;
};

/// An adaptive model of unsigned 32-bit integers, like AdaptiveInteger without the sign.
class AdaptiveNatural {
 public:
  void encode(RangeEncoder& encoder, uint32_t value);
  uint32_t decode(RangeDecoder& decoder);

 private:
  AdaptiveSymbol<6> width_;
  std::array<std::array<AdaptiveBit, 4>, 33> leading_;
};

/// An adaptive model of signed 32-bit integers that cluster round zero: whether it is zero, the sign, then the
/// magnitude in unary, an adaptive bit each, and what is beyond as an exponential Golomb code.
class AdaptiveResidual {
 public:
  void encode(RangeEncoder& encoder, int32_t value);
  int32_t decode(RangeDecoder& decoder);

 private:
  static constexpr uint32_t most_unary = 18;
  AdaptiveBit zero_, negative_;
  std::array<AdaptiveBit, most_unary> more_;
};

}  // namespace lightwell
