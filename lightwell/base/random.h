// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace lightwell {

/// A bijective mix of 64 bits (the finaliser of SplitMix64, Steele et al. 2014).
constexpr uint64_t hash64(uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9u;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

/// The random sequence of (seed, index): photon 7 draws the same numbers whichever thread traces it. PCG-XSH-RR with 64
/// bits of state (O'Neill 2014); seed and index are hashed, since neighbouring states give correlated sequences.
class Random {
 public:
  Random(uint64_t seed, uint64_t index) : state_(hash64(seed ^ hash64(index + 0x9e3779b97f4a7c15u))) { bits(); }

  /// 32 random bits.
  uint32_t bits() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005u + 1442695040888963407u;
    const uint32_t xorshifted = static_cast<uint32_t>((old >> 18 ^ old) >> 27);
    const uint32_t turn = static_cast<uint32_t>(old >> 59);
    return xorshifted >> turn | xorshifted << (-turn & 31);
  }
  /// Uniform in [0, 1), with 24 bits.
  float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
  /// Uniform in 0 ... n-1; n > 0. The bias is below n / 2^32.
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(uint64_t(bits()) * n >> 32); }

 private:
  uint64_t state_;
};

}  // namespace lightwell
