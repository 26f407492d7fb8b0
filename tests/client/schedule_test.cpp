// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/schedule.h"

#include <gtest/gtest.h>

#include "lightwell/light/lattice_stream.h"
#include "tests/client/opened_download.h"

namespace lightwell {
namespace {

constexpr uint64_t length = 300;

/// The streams in the order in which runs of them are chosen when each is asked for at once.
std::vector<size_t> chosen(std::vector<PackStream> streams, Strategy strategy, std::vector<float> weights = {}) {
  OpenedDownload opened(std::move(streams));
  RunOrder order(opened.download);
  weights.resize(opened.download.directory().streams.size(), 1);
  std::vector<size_t> all;
  while (const auto run = choose(order, strategy, weights, length, 1)) {
    all.push_back(run->stream);
    order.asked(*run);
  }
  return all;
}

std::vector<PackStream> one_of_each() {
  return {even_stream(StreamKind::texture, 3), even_stream(StreamKind::mesh, 3), even_stream(StreamKind::light, 3)};
}

using Streams = std::vector<size_t>;

TEST(Schedule, AStrategyLetsItsKindsGoFirst) {
  EXPECT_EQ(chosen(one_of_each(), Strategy::geometry), (Streams{1, 0, 2}));
  EXPECT_EQ(chosen(one_of_each(), Strategy::light), (Streams{2, 1, 0})) << "equal cases go by kind";
  EXPECT_EQ(chosen(one_of_each(), Strategy::interleave), (Streams{2, 1, 0}));
}

TEST(Schedule, AStrategyOutranksWeights) {
  EXPECT_EQ(chosen(one_of_each(), Strategy::geometry, {100, 0, 1000}), (Streams{1, 0, 2}));
}

TEST(Schedule, TheRunThatTakesTheLargestShareOfErrorAwayPerByteGoesFirst) {
  // The first run takes away all of stream 0's error, a third of stream 1's; how large an error is does not count.
  EXPECT_EQ(chosen({even_stream(StreamKind::mesh, 9, 100), even_stream(StreamKind::mesh, 3, 1)}, Strategy::interleave),
            (Streams{1, 0, 0, 0}));
}

TEST(Schedule, BenefitsAreMultipliedByWeights) {
  const auto streams = [] { return std::vector{even_stream(StreamKind::mesh, 9), even_stream(StreamKind::mesh, 3)}; };
  EXPECT_EQ(chosen(streams(), Strategy::interleave, {2.9f, 1}), (Streams{1, 0, 0, 0}));
  EXPECT_EQ(chosen(streams(), Strategy::interleave, {3.1f, 1}), (Streams{0, 0, 0, 1}));
  EXPECT_EQ(chosen(streams(), Strategy::interleave, {1, 0}), (Streams{0, 0, 0, 1})) << "weight 0 comes last";
}

// Bricks mend the light of their grid, however little each of their streams has: the one in view goes first, after the
// grid's own nodes, which mend more.
TEST(Schedule, BricksInViewComeFirstAndAreWorthWhatTheyMendOfTheirGrid) {
  const auto bricks = [](uint32_t region) {
    PackStream stream = even_stream(StreamKind::bricks, 3, 0.2f);
    ByteWriter parameters;
    BricksLayout{0, region}.write(parameters);
    stream.parameters = parameters.release();
    return stream;
  };
  const std::vector<PackStream> streams{even_stream(StreamKind::light, 3, 1), bricks(0), bricks(1),
                                        even_stream(StreamKind::mesh, 9, 1)};
  EXPECT_EQ(chosen(streams, Strategy::light, {1, 0.01f, 1, 1}), (Streams{0, 2, 1, 3, 3, 3}));
  EXPECT_EQ(chosen(streams, Strategy::interleave, {1, 0.01f, 1, 1}), (Streams{0, 3, 3, 3, 2, 1}))
      << "a fifth of the grid's error is less than a third of a mesh's";
}

TEST(Schedule, StreamsWithoutErrorComeLast) {
  EXPECT_EQ(
      chosen({even_stream(StreamKind::mesh, 3, 0), even_stream(StreamKind::mesh, 30)}, Strategy::interleave).back(),
      0u);
}

TEST(Schedule, NothingIsChosenWhenEverythingIsAskedForOrThereIsNothing) {
  EXPECT_TRUE(chosen({}, Strategy::interleave).empty());
  EXPECT_TRUE(chosen({even_stream(StreamKind::mesh, 0)}, Strategy::interleave).empty());
}

// A page takes no error away by itself: it is worth the average of all that follows it.
TEST(Schedule, APageIsWorthWhatFollowsIt) {
  OpenedDownload opened({even_stream(StreamKind::mesh, 128), even_stream(StreamKind::mesh, 300)});
  RunOrder order(opened.download);
  const std::vector<float> weights = {1, 1};
  const uint64_t all_known = 100 * 65;  // so that pages are due at once
  const lightwell::Run first = choose(order, Strategy::interleave, weights, all_known, 2).value();
  EXPECT_EQ(first.stream, 0u) << "128 blocks share the error that 300 share there";
  EXPECT_TRUE(opened.download.table(0).extent(first.first).page);
}

}  // namespace
}  // namespace lightwell
