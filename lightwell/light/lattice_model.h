// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <span>

#include "lightwell/base/range_coder.h"
#include "lightwell/light/lattice_value.h"

namespace lightwell {

// The parts that encoder and decoder of a lattice stream share. Integers only, so that native and WebAssembly builds
// agree to the bit.

/// What is expected of a node: the mean of its parents that are valid, or of all when none is; valid when half of them
/// are.
class LatticeExpectation {
 public:
  LatticeExpectation() = default;
  explicit LatticeExpectation(std::span<const LatticeValue* const> parents) {
    size_t valid = 0;
    for (const LatticeValue* parent : parents) valid += parent->valid;
    const auto count = static_cast<int32_t>(valid > 0 ? valid : parents.size());
    if (count == 0) return;
    std::array<int32_t, LatticeValue::count> sum{};
    for (const LatticeValue* parent : parents) {
      if (valid > 0 && !parent->valid) continue;
      for (size_t i = 0; i < sum.size(); i++) sum[i] += parent->v[i];
    }
    for (size_t i = 0; i < sum.size(); i++) {
      const int32_t twice = 2 * sum[i] + count;  // rounded down when halved, below zero too
      value_.v[i] = static_cast<int16_t>((twice >= 0 ? twice : twice - 2 * count + 1) / (2 * count));
    }
    value_.valid = 2 * valid >= parents.size();
    agreement_ = valid == 0 ? 0 : valid == parents.size() ? 2 : 1;
  }

  const LatticeValue& value() const { return value_; }
  /// 0 when no parent is valid, 2 when all are, else 1.
  size_t agreement() const { return agreement_; }

 private:
  LatticeValue value_{.v = {}, .valid = true};
  size_t agreement_ = 2;
};

/// The adaptive contexts of a lattice stream. code() both encodes and decodes: `coder` is a ModelWriter or a
/// ModelReader (base/model_coder.h).
class LatticeCoder {
 public:
  /// Of an invalid node only that it is one is coded: it takes the expected value.
  template <typename Coder>
  void code(Coder& coder, LatticeValue& value, const LatticeExpectation& expected, const LatticeSteps& steps) {
    const bool valid = coder.bit(valid_[expected.agreement()], value.valid);
    if (!valid) value = expected.value();
    value.valid = valid;
    if (!valid) return;
    Recent recent;
    for (size_t i = 0; i < LatticeValue::irradiances; i += 3)
      code_colour(coder, irradiance_, value, expected, i, recent, steps);
    Recent recent_mixed;
    for (size_t i = LatticeValue::irradiances; i < LatticeValue::count; i += 3)
      code_colour(coder, mixed_, value, expected, i, recent_mixed, steps);
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
  using Models = std::array<std::array<AdaptiveResidual, 8>, 3>;

  /// Green first; red and blue are expected to deviate as it does, nearly.
  template <typename Coder>
  void code_colour(Coder& coder, Models& models, LatticeValue& value, const LatticeExpectation& expected, size_t first,
                   Recent& recent, const LatticeSteps& steps) {
    int32_t shift = 0;
    for (const size_t c : {size_t(1), size_t(0), size_t(2)}) {
      const size_t i = first + c;
      const int32_t likely = expected.value().v[i] + shift;
      const int32_t residual = coder.residual(models[c][recent.context()], value.v[i] - likely);
      value.v[i] = steps.clamp(i, static_cast<int32_t>(std::clamp<int64_t>(int64_t(likely) + residual, -32768, 32767)));
      recent.learn(value.v[i] - likely);
      if (c == 1) shift = (value.v[i] - likely) * 7 / 8;
    }
  }

  std::array<AdaptiveBit, 3> valid_;
  Models irradiance_;
  Models mixed_;
};

}  // namespace lightwell
