// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/line_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

/// A line that brings its bytes in pieces of 10 ms at a steady rate, measured for some seconds.
LineEstimate steady(double bytes_a_second, double seconds) {
  LineEstimate line(1);
  double now = 5;
  line.sent(now, true);
  for (int i = 0; i < 100 * seconds; i++) line.arrived(static_cast<uint64_t>(bytes_a_second / 100), now += 0.01);
  return line;
}

TEST(LineEstimate, AsksFor64KilobytesAtFirst) { EXPECT_EQ(LineEstimate(1).request_length(), 65536u); }

// The estimate halves its distance to the truth with every tenth of a second; three seconds leave 2^-30 of it, and
// bytes are counted in whole pieces, less than one in a thousand of which is lost.
TEST(LineEstimate, ARequestTakesATenthOfASecondAtTheThroughput) {
  for (const double rate : {5e4, 2e5, 1e6, 5e6})
    EXPECT_NEAR(static_cast<double>(steady(rate, 3).request_length()), rate / 10, rate / 1000) << rate;
}

TEST(LineEstimate, RequestsAreNeitherTinyNorHuge) {
  EXPECT_EQ(steady(1000, 30).request_length(), 4096u);
  EXPECT_EQ(steady(1e9, 3).request_length(), uint64_t(1) << 20);
}

TEST(LineEstimate, TheTimeWithoutARequestDoesNotCount) {
  LineEstimate line = steady(1e6, 3), paused = line;
  line.sent(8.0, true);
  paused.sent(1000, true);
  for (int i = 1; i <= 20; i++) {
    line.arrived(10000, 8.0 + 0.01 * i);
    paused.arrived(10000, 1000 + 0.01 * i);
  }
  EXPECT_NEAR(static_cast<double>(paused.request_length()), static_cast<double>(line.request_length()), 1);
}

TEST(LineEstimate, AnotherRequestOnItsWayDoesNotBeginTheMeasureAnew) {
  LineEstimate line(1);
  line.sent(0, true);
  for (int i = 1; i <= 300; i++) {
    line.sent(0.01 * i, false);
    line.arrived(2000, 0.01 * i);
  }
  EXPECT_NEAR(static_cast<double>(line.request_length()), 2e4, 2e2);
}

TEST(LineEstimate, PausesDoubleUpToHalfAMinuteAndAreSpread) {
  LineEstimate line(7);
  double now = 100, longest = 0.25;
  bool spread = false;
  for (int failure = 0; failure < 20; failure++) {
    line.failed(now);
    const double pause = line.retry_at() - now;
    EXPECT_GE(pause, longest / 2) << failure;
    EXPECT_LE(pause, longest) << failure;
    spread = spread || std::abs(pause - 0.75 * longest) > 0.05 * longest;
    now = line.retry_at();
    longest = std::min(30.0, 2 * longest);
    EXPECT_EQ(line.failures(), static_cast<uint32_t>(failure + 1));
  }
  EXPECT_TRUE(spread);
  line.succeeded();
  EXPECT_EQ(line.failures(), 0u);
  line.failed(now);
  EXPECT_LE(line.retry_at() - now, 0.25) << "after a success pauses begin anew";
}

TEST(LineEstimate, AFailureNeverBringsTheNextTryForward) {
  LineEstimate line(3);
  for (int i = 0; i < 10; i++) line.failed(0);
  const double before = line.retry_at();
  line.succeeded();
  line.failed(0);
  EXPECT_GE(line.retry_at(), before);
}

TEST(LineEstimate, AFailureHalvesTheThroughput) {
  LineEstimate line = steady(1e6, 3);
  const uint64_t before = line.request_length();
  line.failed(10);
  EXPECT_NEAR(static_cast<double>(line.request_length()), static_cast<double>(before) / 2, 1);
}

}  // namespace
}  // namespace lightwell
