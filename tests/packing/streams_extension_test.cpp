// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/streams_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/nasty_json.h"

namespace lightwell {
namespace {

Json pack_of(const PackIdentity& identity) { return {{"extensions", {{streams_extension, to_json(identity)}}}}; }

void expect_same(const PackIdentity& a, const PackIdentity& b) {
  EXPECT_EQ(a.version, b.version);
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.generator, b.generator);
  EXPECT_EQ(a.exposure, b.exposure);
}

PackIdentity any_identity(Random& random) {
  return {random.below(9), std::to_string(random.below(1000000)), "lightwell", 20 * random.uniform() - 10};
}

TEST(StreamsExtension, ReadsWhatItWrites) {
  for (uint64_t i = 0; i < 100; i++) {
    Random random(41, i);
    const PackIdentity identity = any_identity(random);
    const auto again = read_identity(Json::parse(pack_of(identity).dump()));
    ASSERT_TRUE(again) << again.error().message();
    expect_same(*again, identity);
  }
}

TEST(StreamsExtension, ReadsAnyJsonAsAnIdentityOrAnError) {
  int refused = 0;
  for (uint64_t i = 0; i < 1000; i++) {
    Random random(42, i);
    Json json = pack_of(any_identity(random));
    spoil(json, random);
    const auto identity = read_identity(json);
    if (!identity) {
      refused++;
      EXPECT_TRUE(identity.error().element.starts_with(streams_extension)) << identity.error().message();
      continue;
    }
    expect_same(read_identity(pack_of(*identity)).value(), *identity);
  }
  EXPECT_GT(refused, 300);  // else the changes would not be nasty
}

}  // namespace
}  // namespace lightwell
