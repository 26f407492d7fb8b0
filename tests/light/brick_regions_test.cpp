// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/brick_regions.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "lightwell/light/lattice_stream.h"
#include "tests/light/brick_fields.h"

namespace lightwell {
namespace {

std::vector<uint8_t> written(const LatticeLayout& layout) {
  ByteWriter writer;
  layout.write(writer);
  return writer.release();
}

LatticeDecoder opened(const LatticeStream& stream) {
  uint64_t bytes = 0;
  const auto add = [&](const std::vector<LightBundle>& bundles) {
    for (const LightBundle& bundle : bundles) bytes += bundle.payload.size();
  };
  add(stream.bundles);
  std::ranges::for_each(stream.regions, add);
  return std::move(LatticeDecoder::open(written(stream.layout), bytes).value());
}

LatticeStream apart(const LightGrid& grid, int halvings) {
  return encode_lattice(grid, {.halvings = halvings}).value();
}

TEST(BrickRegions, HoldEveryBrickOnceWithWhatLiesAroundIt) {
  for (uint64_t seed = 0; seed < 20; seed++) {
    const LightGrid grid = bricked_grid(seed, 60);
    for (int halvings = 0; halvings <= BrickRegions::most_halvings; halvings++) {
      const BrickRegions split = BrickRegions::split(grid.tree.ordered(), halvings);
      ASSERT_EQ(split.tree.bricks().size(), grid.tree.bricks().size()) << "parents come first, or they are not added";
      for (const Brick& brick : grid.tree.bricks()) EXPECT_TRUE(split.tree.find(brick));
      EXPECT_LE(split.regions.size(), size_t(1) << halvings);
      uint32_t next = 0;
      for (const BrickRegion& region : split.regions) {
        EXPECT_EQ(region.begin, next);
        EXPECT_GT(region.end, region.begin);
        next = region.end;
        for (uint32_t i = region.begin; i < region.end; i++) {
          const Brick& brick = split.tree.bricks()[i];
          EXPECT_TRUE(i == region.begin || split.tree.bricks()[i - 1].level <= brick.level) << "level by level";
          const int scale = 1 << brick.level;
          const Vec3i first = brick.at * Brick::cells, last = first + Vec3i::filled(Brick::cells);
          EXPECT_EQ(min(first, region.lo * scale), region.lo * scale);
          EXPECT_EQ(max(last, region.hi * scale), region.hi * scale);
        }
      }
      EXPECT_EQ(next, split.tree.bricks().size());
    }
  }
}

TEST(BrickRegions, AreOfLikeSize) {
  BrickTree tree(Vec3i::filled(32));
  for (int i = 0; i < 16 * 16 * 16; i++) tree.add({.level = 1, .at = {{i % 16, i / 16 % 16, i / 256}}});
  for (const BrickRegion& region : BrickRegions::split(tree.ordered(), 3).regions) EXPECT_EQ(region.count(), 512u);
  const std::vector<BrickRegion> whole = BrickRegions::split(tree.ordered(), 0).regions;
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole.front().count(), 4096u);
}

// Whatever comes first, in the end each region has what it has when all come in one stream.
TEST(BrickRegions, ComeInAnyOrder) {
  for (uint64_t seed = 0; seed < 12; seed++) {
    const LightGrid grid = bricked_grid(seed, 60);
    const LatticeStream whole = apart(grid, 0);
    LatticeDecoder in_one = opened(whole);
    for (const LightBundle& bundle : whole.bundles) ASSERT_TRUE(in_one.append(bundle.payload));
    const LightGrid expected = in_one.grid(Fill::push_pull);

    const LatticeStream stream = apart(grid, 3);
    LatticeDecoder decoder = opened(stream);
    EXPECT_FALSE(decoder.append_bricks(0, stream.regions[0][0].payload)) << "the grid's own nodes come first";
    for (const LightBundle& bundle : stream.bundles) ASSERT_TRUE(decoder.append(bundle.payload));
    EXPECT_TRUE(decoder.complete());
    EXPECT_FALSE(decoder.append(stream.regions[0][0].payload)) << "bricks are no part of the grid's stream";
    Random random(seed, 1);
    std::vector<size_t> done(stream.regions.size());
    std::set<size_t> open;
    for (size_t region = 0; region < stream.regions.size(); region++) open.insert(region);
    while (!open.empty()) {
      const size_t region = *std::next(open.begin(), random.below(static_cast<uint32_t>(open.size())));
      const LightBundle& bundle = stream.regions[region][done[region]++];
      const size_t before = decoder.received(region), all = decoder.received();
      ASSERT_TRUE(decoder.append_bricks(region, bundle.payload));
      EXPECT_EQ(decoder.received(region), before + bundle.nodes);
      EXPECT_EQ(decoder.received(), all + bundle.nodes);
      if (!decoder.complete(region)) continue;
      EXPECT_EQ(done[region], stream.regions[region].size());
      EXPECT_FALSE(decoder.append_bricks(region, bundle.payload));
      open.erase(region);
    }
    EXPECT_EQ(decoder.received(), decoder.total());
    const LightGrid found = decoder.grid(Fill::push_pull);
    ASSERT_EQ(found.tree.bricks().size(), expected.tree.bricks().size());
    for (uint32_t brick = 0; brick < found.bricks.size(); brick++) {
      const uint32_t same = expected.tree.find(found.tree.bricks()[brick]).value();
      for (size_t point = 0; point < Brick::points; point++) {
        EXPECT_EQ(found.bricks[brick][point].moments.m, expected.bricks[same][point].moments.m);
        EXPECT_EQ(found.bricks[brick][point].weight, expected.bricks[same][point].weight);
      }
    }
  }
}

TEST(BrickRegions, AnyPrefixIsRefusedOrTheWhole) {
  const LatticeStream stream = apart(bricked_grid(5, 60), 2);
  LatticeDecoder decoder = opened(stream);
  for (const LightBundle& bundle : stream.bundles) ASSERT_TRUE(decoder.append(bundle.payload));
  const std::vector<uint8_t>& payload = stream.regions[1][0].payload;
  // The range coder ends in up to four bytes that say nothing.
  for (size_t length = 0; length + 4 < payload.size(); length += 1 + length / 16) {
    EXPECT_FALSE(decoder.append_bricks(1, Bytes(payload).first(length))) << length;
    EXPECT_EQ(decoder.received(1), 0u);
  }
  EXPECT_TRUE(decoder.append_bricks(1, payload));
}

// What is left of the error once a region is there is what the others mend.
TEST(BrickRegions, ErrorsFallToWhatOtherRegionsMend) {
  const LatticeStream stream = apart(bricked_grid(7, 60), 2);
  const double before = static_cast<double>(stream.bundles.back().error);
  double mended = 0;
  for (const std::vector<LightBundle>& region : stream.regions) {
    double last = before;
    for (const LightBundle& bundle : region) {
      EXPECT_LE(static_cast<double>(bundle.error), last + 1e-6);
      last = static_cast<double>(bundle.error);
    }
    mended += before * before - last * last;
  }
  EXPECT_NEAR(mended, before * before, 1e-4 * before * before) << "all regions together leave nothing";
}

TEST(BrickRegions, ParametersAreReadBack) {
  const LatticeLayout layout = apart(bricked_grid(9, 60), 2).layout;
  const std::vector<uint8_t> bytes = written(layout);
  const LatticeLayout back = LatticeLayout::read(bytes).value();
  EXPECT_EQ(back.halvings, 2);
  EXPECT_EQ(back.regions.size(), layout.regions.size());
  EXPECT_TRUE(std::ranges::equal(back.tree.bricks(), layout.tree.bricks()));
  LatticeLayout far = layout;
  far.halvings = BrickRegions::most_halvings + 1;
  EXPECT_FALSE(LatticeLayout::read(written(far)));
  ByteWriter of_bricks;
  BricksLayout{7, 3}.write(of_bricks);
  const std::vector<uint8_t> parameters = of_bricks.release();
  EXPECT_EQ(BricksLayout::read(parameters).value().grid, 7u);
  EXPECT_EQ(BricksLayout::read(parameters).value().region, 3u);
  EXPECT_FALSE(BricksLayout::read(Bytes(parameters).first(7)));
}

}  // namespace
}  // namespace lightwell
