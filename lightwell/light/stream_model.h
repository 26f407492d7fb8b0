// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "lightwell/base/range_coder.h"
#include "lightwell/light/grid.h"
#include "lightwell/light/record.h"

namespace lightwell {

// The parts that encoder and decoder of a light stream share: the order of the nodes, their expectation from known
// nodes, and the contexts of the coder. Integers only, so that native and WebAssembly builds agree to the bit.

/// The order of the nodes after the corners. It follows from the seed, so that no positions are sent.
struct LightOrder {
  std::vector<uint32_t> nodes;  ///< every node but the eight corners
  std::vector<uint32_t> ends;   ///< bundle k ends before nodes[ends[k]]
};

/// The stratified order of S08 (Pacanowski, Granier et al., "Efficient Streaming of 3D Scenes with Complex Geometry and
/// Complex Lighting", Web3D 2008, section 4.1): the grid is cut into slices across its longest axis (the first of
/// several), and every bundle holds nodes_per_slice nodes of each slice, or those that are left, at places drawn
/// without replacement from Random(seed, slice).
LightOrder light_order(const GridShape& shape, uint64_t seed, int nodes_per_slice);

/// The eight corner nodes of a grid, x fastest.
std::array<size_t, 8> corner_nodes(const GridShape& shape);

/// The record predicted for a node: E in units of 2^-24 (a mantissa times 2 to the exponent), S as in the record.
struct RecordExpectation {
  std::array<std::array<int64_t, 3>, 6> irradiance{};
  std::array<int, 9> mixed{};
};

/// The known nodes nearest to a node, with integer weights that fall with the fourth power of the distance.
struct KnownNeighbours {
  struct Neighbour {
    uint32_t node;
    int weight;
  };
  std::array<Neighbour, 32> items;
  size_t count = 0;
};

/// The records that are known so far.
class RecordField {
 public:
  explicit RecordField(const GridShape& shape) : shape_(shape), records_(shape.count()), known_(shape.count(), 0) {}

  void set(size_t node, const MomentsRecord& record) {
    records_[node] = record;
    known_[node] = 1;
  }
  void forget(size_t node) { known_[node] = 0; }
  std::span<const uint8_t> known() const { return known_; }
  const MomentsRecord& operator[](size_t node) const { return records_[node]; }

  /// The known nodes in the smallest cube shell around a node that contains any, at most 32. Some node must be known.
  KnownNeighbours neighbours(size_t node) const;
  /// The weighted mean of the neighbours whose validity is `valid`, or of all when there are none.
  RecordExpectation expect(const KnownNeighbours& neighbours, bool valid) const;

 private:
  GridShape shape_;
  std::vector<MomentsRecord> records_;
  std::vector<uint8_t> known_;
};

/// Mantissas and the shared exponent of an RGB9E5.
struct SharedExponent {
  std::array<int, 3> mantissa{};
  int exponent = 0;

  static SharedExponent of(uint32_t bits);
  uint32_t bits() const;
};

/// The adaptive contexts of a light stream. code() both encodes and decodes: `coder` is a ModelWriter or a ModelReader
/// (base/model_coder.h).
class RecordCoder {
 public:
  template <typename Coder>
  void code(Coder& coder, MomentsRecord& record, const RecordField& field, size_t node);

 private:
  // The running magnitude of a node's residuals, used as a context since noise comes in patches.
  struct Recent {
    int magnitude = 8;
    size_t context() const { return std::min<size_t>(std::bit_width(static_cast<unsigned>(magnitude)), 7); }
    void learn(int residual) { magnitude = (magnitude + 2 * std::min(std::abs(residual), 511) + 1) / 3; }
  };

  template <typename Coder>
  uint32_t code_irradiance(Coder& coder, uint32_t bits, const std::array<int64_t, 3>& expected, size_t direction,
                           Recent& recent);
  template <typename Coder>
  int8_t code_mixed(Coder& coder, int8_t value, int expected, size_t entry, Recent& recent);

  std::array<AdaptiveBit, 3> invalid_;
  std::array<AdaptiveInteger, 6> exponent_;
  std::array<std::array<AdaptiveInteger, 8>, 3> mantissa_;
  std::array<std::array<AdaptiveInteger, 8>, 3> mixed_;
};

/// The exponent that RGB9E5 would share among the expected values.
int shared_exponent(const std::array<int64_t, 3>& values);

template <typename Coder>
void RecordCoder::code(Coder& coder, MomentsRecord& record, const RecordField& field, size_t node) {
  const KnownNeighbours around = field.neighbours(node);
  size_t invalid = 0;
  for (size_t i = 0; i < around.count; i++) invalid += !field[around.items[i].node].valid();
  const size_t agreement = invalid == 0 ? 0 : invalid == around.count ? 2 : 1;
  const bool valid = !coder.bit(invalid_[agreement], !record.valid());

  const RecordExpectation expected = field.expect(around, valid);
  Recent recent;
  for (size_t d = 0; d < 6; d++) {
    record.irradiance[d] = code_irradiance(coder, record.irradiance[d], expected.irradiance[d], d, recent);
  }
  if (!valid) record.mixed[0] = MomentsRecord::invalid_mark;
  Recent recent_mixed;
  for (size_t i = valid ? 0 : 1; i < 9; i++) {
    record.mixed[i] = code_mixed(coder, record.mixed[i], expected.mixed[i], i, recent_mixed);
  }
}

// Codes green first, then predicts that red and blue deviate from their expectation in proportion to green.
template <typename Coder>
uint32_t RecordCoder::code_irradiance(Coder& coder, uint32_t bits, const std::array<int64_t, 3>& expected,
                                      size_t direction, Recent& recent) {
  SharedExponent value = SharedExponent::of(bits);
  const int likely = shared_exponent(expected);
  value.exponent = static_cast<int>(
      std::clamp<int64_t>(int64_t(likely) + coder.integer(exponent_[direction], value.exponent - likely), 0, 31));

  std::array<int, 3> mantissa;
  for (size_t c = 0; c < 3; c++) {
    mantissa[c] =
        static_cast<int>(std::min<int64_t>((expected[c] + (int64_t(1) << value.exponent >> 1)) >> value.exponent, 511));
  }
  const int green = mantissa[1];
  for (const size_t c : {size_t(1), size_t(0), size_t(2)}) {
    if (c != 1 && green > 0) {
      const int change = mantissa[c] * (value.mantissa[1] - green) * 7 / (8 * green);
      mantissa[c] = std::clamp(mantissa[c] + change, 0, 511);
    }
    const int residual = coder.integer(mantissa_[c][recent.context()], value.mantissa[c] - mantissa[c]);
    value.mantissa[c] = static_cast<int>(std::clamp<int64_t>(int64_t(mantissa[c]) + residual, 0, 511));
    recent.learn(value.mantissa[c] - mantissa[c]);
  }
  return value.bits();
}

template <typename Coder>
int8_t RecordCoder::code_mixed(Coder& coder, int8_t value, int expected, size_t entry, Recent& recent) {
  const int residual = coder.integer(mixed_[entry % 3][recent.context()], value - expected);
  const auto decoded = static_cast<int>(std::clamp<int64_t>(int64_t(expected) + residual, -127, 127));
  recent.learn(decoded - expected);
  return static_cast<int8_t>(decoded);
}

}  // namespace lightwell
