// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/http_date.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

TEST(HttpDate, IsTheExampleOfTheStandard) { EXPECT_EQ(http_date(784111777), "Sun, 06 Nov 1994 08:49:37 GMT"); }

TEST(HttpDate, IsReadBack) {
  Random random(1, 0);
  for (int i = 0; i < 1000; i++) {
    const auto time = static_cast<std::time_t>(random.below(0xffffffff));  // until 2106
    std::tm read{};
    const std::string text = http_date(time);
    ASSERT_NE(::strptime(text.c_str(), "%a, %d %b %Y %H:%M:%S GMT", &read), nullptr) << text;
    EXPECT_EQ(::timegm(&read), time) << text;
  }
}

}  // namespace
}  // namespace lightwell
