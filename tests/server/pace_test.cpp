// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/pace.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

using namespace std::chrono_literals;

const Pace::Clock::time_point begin{};

TEST(Pace, WhoTakesNothingHasTheTimeOfOnePortion) {
  Pace pace(begin, 30s);
  pace.taken(0, begin + 20s);
  EXPECT_EQ(pace.end(), begin + 30s);
}

TEST(Pace, APortionInTimeIsAlwaysEnough) {
  Pace pace(begin, 30s);
  for (int portions = 1; portions < 1000; portions++) {
    const auto now = begin + 30s * portions - 1s;
    EXPECT_GT(pace.end(), now);
    pace.taken(Pace::portion * static_cast<uint64_t>(portions), now);
  }
}

TEST(Pace, PortionsMayComeManyAtOnce) {
  Pace pace(begin, 30s);
  for (int batches = 1; batches < 100; batches++) {
    pace.taken(Pace::portion * 16 * static_cast<uint64_t>(batches), begin + 480s * (batches - 1));
    EXPECT_GE(pace.end(), begin + 480s * batches);
  }
}

TEST(Pace, NobodyBuysMuchInAdvance) {
  Pace pace(begin, 30s);
  pace.taken(1u << 30, begin + 1s);
  EXPECT_EQ(pace.end(), begin + 1s + 30s * Pace::most_portions);
}

TEST(Pace, LessThanThePaceRunsOutOfTime) {
  Pace pace(begin, 30s);
  auto now = begin;
  for (uint64_t taken = 0; now < pace.end(); taken += Pace::portion / 2) {
    pace.taken(taken, now);
    now += 30s;
    ASSERT_LT(now, begin + 120s) << "each half portion costs a whole one's time";
  }
}

TEST(Pace, KnowsTheRate) {
  Pace pace(begin, 30s);
  pace.taken(5000, begin + 1s);
  EXPECT_DOUBLE_EQ(pace.rate(begin + 5s), 1000);
}

}  // namespace
}  // namespace lightwell
