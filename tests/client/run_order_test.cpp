// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/run_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lightwell/base/random.h"
#include "tests/client/opened_download.h"

namespace lightwell {
namespace {

TEST(RunOrder, CutsAStreamIntoRunsOfTheLengthAskedFor) {
  OpenedDownload opened({even_stream(StreamKind::mesh, 20)});
  RunOrder order(opened.download);
  uint32_t next = 0;
  while (const auto run = order.missing(0, 350, 0)) {
    EXPECT_EQ(run->first, next);
    EXPECT_EQ(run->count, std::min(3u, 20 - next)) << "three blocks of 100 bytes are in 350";
    EXPECT_EQ(run->end - run->begin, 100u * run->count);
    EXPECT_EQ(run->begin, opened.download.table(0).extent(next).begin);
    order.asked(*run);
    next += run->count;
  }
  EXPECT_EQ(next, 20u);
}

TEST(RunOrder, AlwaysAsksForAtLeastOneExtent) {
  OpenedDownload opened({even_stream(StreamKind::mesh, 2)});
  EXPECT_EQ(RunOrder(opened.download).missing(0, 1, 0)->count, 1u);
}

TEST(RunOrder, AsksAgainOnlyForWhatHasNotArrived) {
  OpenedDownload opened({even_stream(StreamKind::mesh, 10)});
  RunOrder order(opened.download);
  const lightwell::Run run = order.missing(0, 1000, 0).value();
  ASSERT_EQ(run.count, 10u);
  order.asked(run);
  EXPECT_FALSE(order.missing(0, 1000, 0));
  opened.bring(run.begin, run.begin + 420);  // four blocks and a part of the fifth
  order.unasked(run);
  const lightwell::Run again = order.missing(0, 1000, 0).value();
  EXPECT_EQ(again.first, 4u);
  EXPECT_EQ(again.count, 6u);
}

TEST(RunOrder, LeavesOutWhatArrivedUnasked) {
  OpenedDownload opened({even_stream(StreamKind::mesh, 10)});
  RunOrder order(opened.download);
  const BlockTable& table = opened.download.table(0);
  opened.bring(table.extent(0).begin, table.extent(0).end());
  opened.bring(table.extent(5).begin, table.extent(5).end());
  const lightwell::Run run = order.missing(0, 1000, 0).value();
  EXPECT_EQ(run.first, 1u);
  EXPECT_EQ(run.count, 4u) << "up to the block that is here";
}

TEST(RunOrder, TheNextTablePageComesBeforeTheStreamRunsDry) {
  OpenedDownload opened({even_stream(StreamKind::mesh, 200)});
  RunOrder order(opened.download);
  const uint32_t page = opened.download.table(0).known() - 1;
  ASSERT_TRUE(opened.download.table(0).extent(page).page);
  EXPECT_EQ(order.missing(0, 100, 6400)->first, 0u) << "64 blocks of 100 bytes are known and missing";
  EXPECT_EQ(order.missing(0, 100, 6401)->first, page);
  const lightwell::Run run = order.missing(0, 100, 6401).value();
  order.asked(run);
  EXPECT_EQ(order.missing(0, 100, 6401)->first, 0u) << "the page is asked for once";
  opened.bring(run.begin, run.end);
  EXPECT_GT(opened.download.table(0).known(), page + 1);
  EXPECT_EQ(order.missing(0, 100, 6401)->first, 0u) << "more is known now";
}

// Whatever is asked for, brought in part and given up in any order: in the end everything is here, and nothing was
// asked for twice while it was under way or here.
TEST(RunOrder, EverythingArrivesHoweverRequestsEnd) {
  for (uint64_t seed = 0; seed < 30; seed++) {
    Random random(seed, 0);
    OpenedDownload opened({even_stream(StreamKind::light, 150), even_stream(StreamKind::mesh, 70)});
    RunOrder order(opened.download);
    std::vector<lightwell::Run> under_way;
    const auto is_under_way = [&](const lightwell::Run& run, uint32_t extent) {
      return std::ranges::any_of(under_way, [&](const lightwell::Run& other) {
        return other.stream == run.stream && extent >= other.first && extent < other.first + other.count;
      });
    };
    for (int step = 0; step < 5000; step++) {
      const size_t stream = random.below(2);
      if (const auto run = order.missing(stream, random.below(2000), random.below(5000)); run && under_way.size() < 4) {
        for (uint32_t i = run->first; i < run->first + run->count; i++) {
          ASSERT_FALSE(opened.download.here(stream, i));
          ASSERT_FALSE(is_under_way(*run, i));
        }
        order.asked(*run);
        under_way.push_back(*run);
      } else if (!under_way.empty()) {
        const size_t ends = random.below(static_cast<uint32_t>(under_way.size()));
        const lightwell::Run ended = under_way[ends];
        under_way.erase(under_way.begin() + static_cast<ptrdiff_t>(ends));
        const auto length = static_cast<uint32_t>(ended.end - ended.begin);
        opened.bring(ended.begin, ended.begin + std::min(length, random.below(2 * length)));
        order.unasked(ended);
      }
    }
    for (const size_t stream : {0u, 1u}) {
      EXPECT_FALSE(order.missing(stream, 1, 0));
      for (uint32_t i = 0; i < opened.download.table(stream).extents(); i++)
        EXPECT_TRUE(opened.download.here(stream, i));
    }
  }
}

}  // namespace
}  // namespace lightwell
