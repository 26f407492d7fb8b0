// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "lightwell/base/bytes.h"
#include "lightwell/base/crc32c.h"
#include "lightwell/base/half.h"
#include "lightwell/base/parallel.h"
#include "lightwell/base/random.h"
#include "lightwell/base/transform.h"

namespace lightwell {
namespace {

TEST(Crc32c, HasThePublishedCheckValue) {
  EXPECT_EQ(crc32c(as_bytes("123456789")), 0xe3069283u);
  EXPECT_EQ(crc32c(std::vector<uint8_t>(32, 0)), 0x8a9136aau);  // RFC 3720 B.4
  EXPECT_EQ(crc32c(as_bytes("6789"), crc32c(as_bytes("12345"))), 0xe3069283u);
}

TEST(ByteReader, FailsForGoodPastTheEnd) {
  ByteWriter writer;
  writer.u16(0x1234);
  writer.f32(1.5f);
  ByteReader reader(writer.bytes());
  EXPECT_EQ(reader.u16(), 0x1234);
  EXPECT_EQ(reader.f32(), 1.5f);
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.u64(), 0u);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.u8(), 0);
}

TEST(Half, RoundTripsEveryFiniteHalf) {
  for (uint32_t h = 0; h < 0x10000; h++) {
    if ((h & 0x7c00) == 0x7c00 || h == 0x8000) continue;
    ASSERT_EQ(to_half(from_half(static_cast<uint16_t>(h))), h);
  }
}

// Half a unit in the last place: 2^-11 relative for normal numbers, 2^-25 absolute below.
TEST(Half, IsTheNearest) {
  Random random(1, 0);
  for (int i = 0; i < 100000; i++) {
    const float value = std::ldexp(random.uniform() * 2 - 1, static_cast<int>(random.below(40)) - 25);
    const float error = std::abs(from_half(to_half(value)) - value);
    ASSERT_LE(error, std::max(std::abs(value) * 0x1p-11f, 0x1p-25f)) << value;
  }
  EXPECT_EQ(from_half(to_half(1e9f)), 65504.0f);
  EXPECT_EQ(from_half(to_half(-1e9f)), -65504.0f);
}

TEST(Random, GivesEachIndexItsOwnUniformNumbers) {
  double sum = 0, of_products = 0;
  const int count = 20000;
  for (uint64_t i = 0; i < count; i++) {
    const double a = Random(5, i).uniform(), b = Random(5, i + 1).uniform();
    sum += a;
    of_products += (a - 0.5) * (b - 0.5);
  }
  EXPECT_NEAR(sum / count, 0.5, 4 * std::sqrt(1.0 / 12 / count));  // four standard errors
  EXPECT_NEAR(of_products / count, 0, 4 / 12.0 / std::sqrt(count));
}

TEST(Parallel, WhatABodyThrowsReachesTheCaller) {
  for (const int threads : {1, 4}) {
    std::atomic<int> calls = 0;
    std::atomic<bool> throws = false;
    const auto run = [&] {
      parallel_for(100000, 1, threads, [&](size_t i, size_t, int) {
        calls++;
        if (i == 10) {
          throws = true;
          throw std::bad_alloc();
        }
        // All items would take seconds: even a busy machine gets round to the one that throws before.
        while (i > 10 && !throws) std::this_thread::yield();
        if (i > 10) std::this_thread::sleep_for(std::chrono::microseconds(100));
      });
    };
    EXPECT_THROW(run(), std::bad_alloc);
    EXPECT_LT(calls, 100000);  // the others' work has ended, too
  }
}

TEST(Parallel, VisitsEveryItemOnce) {
  for (int threads : {1, 2, 7}) {
    std::vector<std::atomic<int>> visits(1001);
    parallel_for(visits.size(), 10, threads, [&](size_t begin, size_t end, int thread) {
      EXPECT_LT(thread, threads);
      for (size_t i = begin; i < end; i++) visits[i]++;
    });
    for (auto& visit : visits) ASSERT_EQ(visit, 1);
  }
}

TEST(Transform, InverseAndNormalAreRight) {
  Random random(3, 0);
  auto number = [&] { return static_cast<double>(random.uniform()) * 4 - 2; };
  for (int i = 0; i < 100; i++) {
    const Transform m{{{number(), number(), number()}},
                      {{number(), number(), number()}},
                      {{number(), number(), number()}},
                      {{number(), number(), number()}}};
    if (std::abs(m.determinant()) < 0.1) continue;
    const Vec3d p{{number(), number(), number()}};
    EXPECT_LT(length((m.inverse() * m).point(p) - p), 1e-9);
    const Vec3f a{{1, 0.5f, -2}}, b{{0.25f, 1, 1}};
    const Vec3f n = m.normal(normalized(cross(a, b)));
    EXPECT_NEAR(dot(n, normalized(m.vector(a))), 0, 1e-5);  // a tangent stays perpendicular; float vectors
    EXPECT_NEAR(dot(n, normalized(m.vector(b))), 0, 1e-5);
  }
}

}  // namespace
}  // namespace lightwell
