// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "lightwell/base/range_coder.h"
#include "lightwell/light/lattice_record.h"

namespace lightwell {

// The parts that encoder and decoder of a lattice stream share. Integers only, so that native and WebAssembly builds
// agree to the bit.

/// A node between which another lies.
struct LatticeParent {
  const int32_t* numbers = nullptr;  ///< those of its record, then whether it is valid
  uint8_t axis = 0;                  ///< along which it lies
  bool blocked = false;              ///< a surface stands between the two
};

/// The parents of a node: two on each axis that its level divides.
class LatticeParents {
 public:
  void add(const LatticeParent& parent) { parents_[count_++] = parent; }
  std::span<LatticeParent> all() { return {parents_.data(), count_}; }
  std::span<const LatticeParent> all() const { return {parents_.data(), count_}; }

 private:
  std::array<LatticeParent, 6> parents_{};
  size_t count_ = 0;
};

/// What is expected of a node: the mean of its parents that are valid and in sight, or of those that are valid, or of
/// all; valid when half of all are.
class LatticeExpectation {
 public:
  LatticeExpectation(const LatticeRecord& record, const LatticeParents& parents) : record_(record) {
    const size_t count = record.numbers().size();
    size_t valid = 0, open = 0;
    for (const LatticeParent& parent : parents.all()) {
      valid += parent.numbers[count] != 0;
      open += parent.numbers[count] != 0 && !parent.blocked;
    }
    for (const LatticeParent& parent : parents.all()) {
      const bool is_valid = parent.numbers[count] != 0;
      if (open > 0 ? is_valid && !parent.blocked : is_valid || valid == 0) used_[used_count_++] = parent.numbers;
    }
    valid_ = 2 * valid >= parents.all().size();
    agreement_ = valid == 0 ? 0 : valid == parents.all().size() ? 2 : 1;
    average(count);
  }

  /// The number at a place, when those before it are known.
  int32_t number(size_t place, std::span<const int32_t> before) const {
    const RecordNumber& number = record_.numbers()[place];
    if (number.expected == RecordNumber::Expected::mean) return means_[place];
    if (number.expected == RecordNumber::Expected::largest) return largest(place);
    return scaled(number, place, before[number.exponent]);
  }
  /// Sets a node to all that is expected.
  void fill(std::span<int32_t> numbers) const {
    for (size_t i = 0; i < record_.numbers().size(); i++) numbers[i] = number(i, numbers);
    numbers.back() = valid_;
  }
  /// 0 when no parent is valid, 2 when all are, else 1.
  size_t agreement() const { return agreement_; }

 private:
  void average(size_t count) {
    std::array<int64_t, LatticeRecord::most_numbers> sum;
    for (size_t i = 0; i < count; i++) sum[i] = used_[0][i];
    for (size_t p = 1; p < used_count_; p++)
      for (size_t i = 0; i < count; i++) sum[i] += used_[p][i];
    const auto parents = static_cast<int64_t>(used_count_);
    // Rounded down after a half is added, below zero too. Most nodes have two or four parents: then it is a shift.
    const int shift = std::bit_width(used_count_);
    if ((used_count_ & (used_count_ - 1)) == 0) {
      for (size_t i = 0; i < count; i++) means_[i] = static_cast<int32_t>((2 * sum[i] + parents) >> shift);
      return;
    }
    for (size_t i = 0; i < count; i++) {
      const int64_t twice = 2 * sum[i] + parents;
      means_[i] = static_cast<int32_t>((twice >= 0 ? twice : twice - 2 * parents + 1) / (2 * parents));
    }
  }
  int32_t largest(size_t place) const {
    int32_t most = used_[0][place];
    for (size_t p = 1; p < used_count_; p++) most = std::max(most, used_[p][place]);
    return most;
  }
  int32_t scaled(const RecordNumber& number, size_t place, int32_t exponent) const {
    int64_t sum = 0;
    for (size_t p = 0; p < used_count_; p++) sum += int64_t(used_[p][place]) << used_[p][number.exponent];
    const int64_t mean = sum / static_cast<int64_t>(used_count_);
    const int64_t half = int64_t(1) << exponent >> 1;
    return static_cast<int32_t>(std::clamp<int64_t>((mean + half) >> exponent, number.least, number.most));
  }

  const LatticeRecord& record_;
  std::array<const int32_t*, 6> used_;  // so many
  size_t used_count_ = 0;
  std::array<int32_t, LatticeRecord::most_numbers> means_;  // of the record's
  bool valid_ = true;
  size_t agreement_ = 2;
};

/// The adaptive contexts of a lattice stream. code() and code_links() both encode and decode: `coder` is a ModelWriter
/// or a ModelReader (base/model_coder.h).
class LatticeCoder {
 public:
  /// Which of its valid parents a surface hides from a node.
  template <typename Coder>
  void code_links(Coder& coder, LatticeParents& parents, size_t numbers) {
    size_t blocked = 0;
    for (LatticeParent& parent : parents.all()) {
      if (parent.numbers[numbers] == 0) continue;
      parent.blocked = coder.bit(blocked_[parent.axis][blocked], parent.blocked);
      blocked += parent.blocked;
    }
  }

  /// The numbers of a node's record, and whether it is valid. Of an invalid node only that it is one is coded: it takes
  /// the expected numbers.
  template <typename Coder>
  void code(Coder& coder, const LatticeRecord& record, std::span<int32_t> node, const LatticeExpectation& expected) {
    const bool valid = coder.bit(valid_[expected.agreement()], node.back() != 0);
    if (!valid) expected.fill(node);
    node.back() = valid;
    if (valid) code_numbers(coder, record, node, expected);
  }

 private:
  /// The running magnitude of a node's residuals, used as a context since noise comes in patches.
  struct Recent {
    uint32_t magnitude = 32;  // of 16ths
    size_t context() const { return std::min<size_t>(std::bit_width(magnitude >> 2), 7); }
    void learn(int32_t residual) {
      magnitude = (3 * magnitude + 16 * static_cast<uint32_t>(std::min(std::abs(residual), 255)) + 2) / 4;
    }
  };

  template <typename Coder>
  void code_numbers(Coder& coder, const LatticeRecord& record, std::span<int32_t> node,
                    const LatticeExpectation& expectation) {
    Recent recent;
    int64_t led = 0;  // by how much green has differed
    int32_t led_from = 0;
    for (size_t i = 0; i < record.numbers().size(); i++) {
      const RecordNumber& number = record.numbers()[i];
      if (number.begins) recent = {};
      int32_t expected = expectation.number(i, node);
      if (number.colour == RecordNumber::Colour::follows) {
        expected += static_cast<int32_t>(led * 7 / 8);
      } else if (number.colour == RecordNumber::Colour::follows_in_proportion && led_from > 0) {
        const int64_t likely = expected + expected * led * 7 / (8 * led_from);
        expected = static_cast<int32_t>(std::clamp<int64_t>(likely, number.least, number.most));
      }
      const int32_t residual = coder.residual(models_[number.models][recent.context()], node[i] - expected);
      node[i] = static_cast<int32_t>(std::clamp<int64_t>(int64_t(expected) + residual, number.least, number.most));
      if (number.expected != RecordNumber::Expected::largest) recent.learn(node[i] - expected);
      if (number.colour != RecordNumber::Colour::leads) continue;
      led = node[i] - expected;
      led_from = expected;
    }
  }

  std::array<AdaptiveBit, 3> valid_;
  std::array<std::array<AdaptiveBit, 6>, 3> blocked_;
  std::array<std::array<AdaptiveResidual, 8>, LatticeRecord::most_models> models_;
};

}  // namespace lightwell
