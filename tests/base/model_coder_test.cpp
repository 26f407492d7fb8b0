// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/model_coder.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

struct Values {
  bool bit = false;
  uint32_t natural = 0;
  int32_t integer = 0;
  uint32_t raw = 0;

  bool operator==(const Values&) const = default;
};

struct Description {
  AdaptiveBit bit;
  AdaptiveNatural natural;
  AdaptiveInteger integer;

  template <typename Coder>
  Values code(Coder& coder, const Values& given) {
    Values values;
    values.bit = coder.bit(bit, given.bit);
    values.natural = coder.natural(natural, given.natural);
    values.integer = coder.integer(integer, given.integer);
    values.raw = coder.raw(given.raw, 13);
    return values;
  }
};

std::vector<Values> random_values(uint64_t seed, size_t count) {
  Random random(seed, 0);
  std::vector<Values> values(count);
  for (Values& v : values)
    v = {random.below(5) == 0, random.bits() >> random.below(32),
         static_cast<int32_t>(random.bits()) >> random.below(32), random.below(1 << 13)};
  return values;
}

TEST(ModelCoder, OneDescriptionWritesAndReads) {
  for (uint64_t seed = 0; seed < 20; seed++) {
    const std::vector<Values> sent = random_values(seed, 200);
    Description to, from;
    ModelWriter writer;
    for (const Values& values : sent) EXPECT_EQ(to.code(writer, values), values) << "a writer returns what it is given";
    const std::vector<uint8_t> bytes = writer.finish();
    ModelReader reader(bytes);
    const Values ignored{true, 7, -7, 7};
    for (const Values& values : sent) ASSERT_EQ(from.code(reader, ignored), values);
    EXPECT_FALSE(reader.overrun());
  }
}

TEST(ModelCoder, TooShortAPayloadIsAnOverrun) {
  const std::vector<Values> sent = random_values(1, 50);
  Description to;
  ModelWriter writer;
  for (const Values& values : sent) to.code(writer, values);
  const std::vector<uint8_t> bytes = writer.finish();
  for (size_t length = 0; length < bytes.size(); length++) {
    Description from;
    ModelReader reader(Bytes(bytes).first(length));
    for (const Values& values : sent) from.code(reader, values);
    EXPECT_TRUE(reader.overrun()) << length;
  }
}

}  // namespace
}  // namespace lightwell
