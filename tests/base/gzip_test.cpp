// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/gzip.h"

#include <gtest/gtest.h>

#include <string>

namespace lightwell {
namespace {

TEST(Gzip, BringsBackWhatItWasGiven) {
  std::string text;
  for (int i = 0; i < 5000; i++) text += std::to_string(i * i);
  for (const size_t size : {size_t(0), size_t(1), text.size()}) {
    const std::string part = text.substr(0, size);
    const auto packed = gzip(as_bytes(part));
    const auto plain = gunzip(packed, size);
    ASSERT_TRUE(plain);
    EXPECT_EQ(std::string(plain->begin(), plain->end()), part);
  }
}

TEST(Gzip, OfMoreThanTheLimitOrCutShortIsRefused) {
  const std::string zeros(100'000, '0');
  const auto packed = gzip(as_bytes(zeros));
  EXPECT_LT(packed.size(), 1000u);
  EXPECT_FALSE(gunzip(packed, zeros.size() - 1));
  for (size_t size = 0; size < packed.size(); size++) EXPECT_FALSE(gunzip(Bytes(packed).first(size), zeros.size()));
}

}  // namespace
}  // namespace lightwell
