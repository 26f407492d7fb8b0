// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/range_coder.h"

namespace lightwell {

/// ModelWriter and ModelReader are the two directions of one coder. Each function takes the value to write and returns
/// the value in the stream, so that a single template over the two describes both encoder and decoder, and they cannot
/// differ. The reader ignores the values it is given.
class ModelWriter {
 public:
  static constexpr bool writes = true;

  bool bit(AdaptiveBit& model, bool value) { return encoder_.bit(model, value), value; }
  uint32_t natural(AdaptiveNatural& model, uint32_t value) { return model.encode(encoder_, value), value; }
  int32_t integer(AdaptiveInteger& model, int32_t value) { return model.encode(encoder_, value), value; }
  int32_t residual(AdaptiveResidual& model, int32_t value) { return model.encode(encoder_, value), value; }
  template <int Bits>
  uint32_t symbol(AdaptiveSymbol<Bits>& model, uint32_t value) {
    return model.encode(encoder_, value), value;
  }
  /// The low `bits` bits of the value, without a model; bits <= 32.
  uint32_t raw(uint32_t value, int bits) { return encoder_.raw(value, bits), value; }
  /// Ends the stream and returns its bytes.
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  RangeEncoder encoder_;
};

/// See ModelWriter. Any payload decodes to some values, in time bounded by the number of calls.
class ModelReader {
 public:
  static constexpr bool writes = false;

  explicit ModelReader(Bytes payload) : decoder_(payload) {}
  bool bit(AdaptiveBit& model, bool) { return decoder_.bit(model); }
  uint32_t natural(AdaptiveNatural& model, uint32_t) { return model.decode(decoder_); }
  int32_t integer(AdaptiveInteger& model, int32_t) { return model.decode(decoder_); }
  int32_t residual(AdaptiveResidual& model, int32_t) { return model.decode(decoder_); }
  template <int Bits>
  uint32_t symbol(AdaptiveSymbol<Bits>& model, uint32_t) {
    return model.decode(decoder_);
  }
  uint32_t raw(uint32_t, int bits) { return decoder_.raw(bits); }
  /// True when the payload was too short for what has been read.
  bool overrun() const { return decoder_.overrun(); }

 private:
  RangeDecoder decoder_;
};

}  // namespace lightwell
