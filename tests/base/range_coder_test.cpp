// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/range_coder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

struct Step {
  enum class Kind { bit, raw, integer, natural, symbol } kind;
  uint32_t value;
  int count;
};

std::vector<Step> random_steps(uint64_t seed, int length) {
  Random random(seed, 0);
  std::vector<Step> steps;
  for (int i = 0; i < length; i++) {
    Step step{static_cast<Step::Kind>(random.below(5)), 0, static_cast<int>(1 + random.below(32))};
    switch (step.kind) {
      case Step::Kind::bit: step.value = random.below(100) < 3; break;
      case Step::Kind::raw: step.value = random.bits() >> (32 - step.count); break;
      case Step::Kind::integer:
        step.value = random.bits() >> random.below(32);
        if (random.below(2)) step.value = 0 - step.value;
        break;
      case Step::Kind::natural: step.value = random.bits() >> random.below(32); break;
      case Step::Kind::symbol: step.value = random.below(256); break;
    }
    steps.push_back(step);
  }
  return steps;
}

struct Models {
  AdaptiveBit bit;
  AdaptiveInteger integer;
  AdaptiveNatural natural;
  AdaptiveSymbol<8> symbol;
};

std::vector<uint8_t> encode(const std::vector<Step>& steps) {
  RangeEncoder encoder;
  Models models;
  for (const Step& step : steps) switch (step.kind) {
      case Step::Kind::bit: encoder.bit(models.bit, step.value); break;
      case Step::Kind::raw: encoder.raw(step.value, step.count); break;
      case Step::Kind::integer: models.integer.encode(encoder, static_cast<int32_t>(step.value)); break;
      case Step::Kind::natural: models.natural.encode(encoder, step.value); break;
      case Step::Kind::symbol: models.symbol.encode(encoder, step.value); break;
    }
  return encoder.finish();
}

uint32_t decode(RangeDecoder& decoder, Models& models, const Step& step) {
  switch (step.kind) {
    case Step::Kind::bit: return decoder.bit(models.bit);
    case Step::Kind::raw: return decoder.raw(step.count);
    case Step::Kind::integer: return static_cast<uint32_t>(models.integer.decode(decoder));
    case Step::Kind::natural: return models.natural.decode(decoder);
    case Step::Kind::symbol: return models.symbol.decode(decoder);
  }
  return 0;
}

TEST(RangeCoder, ReturnsWhatWasEncoded) {
  for (uint64_t seed = 0; seed < 200; seed++) {
    const std::vector<Step> steps = random_steps(seed, static_cast<int>(seed * 7));
    const std::vector<uint8_t> bytes = encode(steps);
    RangeDecoder decoder(bytes);
    Models models;
    for (const Step& step : steps) ASSERT_EQ(decode(decoder, models, step), step.value) << "seed " << seed;
    EXPECT_FALSE(decoder.overrun());
  }
}

TEST(RangeCoder, TellsWhenThePrefixWasTooShort) {
  const std::vector<Step> steps = random_steps(1, 300);
  const std::vector<uint8_t> bytes = encode(steps);
  for (size_t length = 0; length < bytes.size(); length++) {
    const std::vector<uint8_t> prefix(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(length));
    RangeDecoder decoder(prefix);
    Models models;
    bool same = true;
    for (const Step& step : steps) same = decode(decoder, models, step) == step.value && same;
    EXPECT_TRUE(decoder.overrun() || same) << length;
    if (length + 4 < bytes.size()) {
      EXPECT_TRUE(decoder.overrun()) << length;
    }
  }
}

TEST(RangeCoder, SurvivesAnyBytes) {
  for (uint64_t seed = 0; seed < 200; seed++) {
    Random random(seed, 1);
    std::vector<uint8_t> noise(random.below(200));
    for (uint8_t& byte : noise) byte = static_cast<uint8_t>(random.bits());
    RangeDecoder decoder(noise);
    Models models;
    for (const Step& step : random_steps(seed, 500)) decode(decoder, models, step);
  }
}

// A source that is 1 in p of all cases has the entropy H(p). Two adaptive states cost a few percent over it: the slow
// state alone would cost about 1/(2 * 128 * ln 2) = 0.6 % of a bit, the fast one eight times that.
TEST(RangeCoder, ComesNearTheEntropy) {
  const double p = 0.05;
  Random random(7, 0);
  RangeEncoder encoder;
  AdaptiveBit context;
  const int count = 100000;
  for (int i = 0; i < count; i++) encoder.bit(context, random.uniform() < p);
  const double entropy = -(p * std::log2(p) + (1 - p) * std::log2(1 - p));
  EXPECT_LT(static_cast<double>(encoder.finish().size()) * 8 / count, entropy * 1.05);
}

// Runs of 0xff in the output force carries through pending bytes.
TEST(RangeCoder, CarriesThroughRunsOfOnes) {
  RangeEncoder encoder;
  AdaptiveBit context;
  for (int i = 0; i < 64; i++) encoder.raw(0xffffffffu, 32);
  for (int i = 0; i < 64; i++) encoder.bit(context, true);
  const std::vector<uint8_t> bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  AdaptiveBit again;
  for (int i = 0; i < 64; i++) ASSERT_EQ(decoder.raw(32), 0xffffffffu);
  for (int i = 0; i < 64; i++) ASSERT_TRUE(decoder.bit(again));
}

}  // namespace
}  // namespace lightwell
