// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/byte_range.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

using Kind = ByteRange::Kind;

TEST(ByteRange, FormsOfRfc9110) {
  const auto part = [](uint64_t first, uint64_t length) { return ByteRange{Kind::part, first, length}; };
  EXPECT_EQ(parse_range("bytes=0-0", 100), part(0, 1));
  EXPECT_EQ(parse_range("bytes=10-19", 100), part(10, 10));
  EXPECT_EQ(parse_range("bytes=10-", 100), part(10, 90));
  EXPECT_EQ(parse_range("bytes=-30", 100), part(70, 30));
  EXPECT_EQ(parse_range("bytes=-300", 100), part(0, 100));
  EXPECT_EQ(parse_range("bytes=90-1000", 100), part(90, 10));
  EXPECT_EQ(parse_range("bytes=90-99999999999999999999999", 100), part(90, 10));
}

TEST(ByteRange, BeyondTheEndIsUnsatisfiable) {
  for (const char* header : {"bytes=100-", "bytes=100-200", "bytes=-0", "bytes=99999999999999999999999-"})
    EXPECT_EQ(parse_range(header, 100).kind, Kind::unsatisfiable) << header;
  EXPECT_EQ(parse_range("bytes=0-", 0).kind, Kind::unsatisfiable);
}

TEST(ByteRange, WhatIsNotUnderstoodIsIgnored) {
  for (const char* header : {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=5-3", "items=0-5", "bytes=0-5,7-9",
                             "bytes= 0-5", "bytes=+1-2", "bytes=0x1-2", "bytes=1--2"})
    EXPECT_EQ(parse_range(header, 100), (ByteRange{Kind::whole, 0, 100})) << header;
}

}  // namespace
}  // namespace lightwell
