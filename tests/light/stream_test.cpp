// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/stream.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/light/light_fields.h"
#include "tests/light/stream_parts.h"
#include "tests/trace/chi_square.h"

namespace lightwell {
namespace {

LightDecoder opened(const LightStream& stream) {
  return std::move(LightDecoder::open(parameters(stream.layout), stream_bytes(stream)).value());
}

TEST(LightOrder, SendsEveryNodeOnceAndSlicesAlike) {
  Random random(1, 0);
  for (int i = 0; i < 40; i++) {
    const GridShape shape = random_shape(random, 12);
    const int per_slice = static_cast<int>(1 + random.below(9));
    const LightOrder order = light_order(shape, random.bits(), per_slice);
    std::set<uint32_t> sent(order.nodes.begin(), order.nodes.end());
    for (const size_t corner : corner_nodes(shape)) sent.insert(static_cast<uint32_t>(corner));
    EXPECT_EQ(order.nodes.size(), shape.count() - 8);
    EXPECT_EQ(sent.size(), shape.count());
    EXPECT_EQ(order.ends.empty() ? 0 : order.ends.back(), order.nodes.size());

    const int axis =
        static_cast<int>(std::max_element(shape.nodes.e.begin(), shape.nodes.e.end()) - shape.nodes.e.begin());
    std::vector<int> in_slice(static_cast<size_t>(shape.nodes[axis]), 0);
    for (size_t k = 0; order.ends.size() > 1 && k < order.ends[0]; k++)
      in_slice[static_cast<size_t>(shape.node(order.nodes[k])[axis])]++;
    for (size_t s = 1; order.ends.size() > 1 && s + 1 < in_slice.size(); s++) EXPECT_EQ(in_slice[s], per_slice);
  }
}

// Within a slice any node may come first, and any second: 8 x 8 nodes of each of 12 slices, shuffled 2,000 times.
TEST(LightOrder, ShufflesSlicesEvenly) {
  const GridShape shape{.lo = {}, .cell = Vec3f::filled(1), .nodes = {{8, 8, 14}}};
  std::vector<int> first(64), second(64);
  for (uint64_t seed = 0; seed < 2000; seed++) {
    const LightOrder order = light_order(shape, seed, 1);
    for (size_t slice = 1; slice + 1 < 14; slice++) {
      first[order.nodes[slice] % 64]++;
      second[order.nodes[order.ends[0] + slice] % 64]++;
    }
  }
  EXPECT_GT(chi_square_of_equal_bins(first), least_probability);
  EXPECT_GT(chi_square_of_equal_bins(second), least_probability);
}

TEST(LightStream, ReturnsTheRecordsOfEveryNode) {
  Random random(2, 0);
  for (uint64_t seed = 0; seed < 12; seed++) {
    LightGrid grid = lamp_grid(random_shape(random, 10), seed, 0.05f, seed % 2 == 0);
    for (Moments& m : grid.moments) m = m * std::exp2(static_cast<float>(4 * static_cast<int>(seed) - 22));
    grid.normal_offset = 0.375f;
    const LightStream stream = encode_light(grid, {.bundle_nodes = 64, .seed = seed}).value();
    LightDecoder decoder = opened(stream);
    for (const LightBundle& bundle : stream.bundles) {
      ASSERT_FALSE(decoder.complete());
      const size_t before = decoder.received();
      ASSERT_TRUE(decoder.append(bundle.payload));
      EXPECT_EQ(decoder.received(), before + bundle.nodes);
    }
    ASSERT_TRUE(decoder.complete());
    EXPECT_EQ(decoder.grid().valid, grid.valid);
    EXPECT_EQ(decoder.grid().normal_offset, grid.normal_offset);
    EXPECT_EQ(decoder.grid().shape.nodes, grid.shape.nodes);
    for (size_t i = 0; i < grid.moments.size(); i++) {
      const Moments expected = decode_record(encode_record(grid.moments[i] * stream.layout.scale, grid.valid[i]));
      EXPECT_EQ(decoder.grid().moments[i].m, (expected * (1 / stream.layout.scale)).m);
    }
    EXPECT_FALSE(decoder.append(stream.bundles.empty() ? Bytes{} : Bytes(stream.bundles[0].payload)));
  }
}

TEST(LightStream, IsTheSameEveryTime) {
  const LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{3, 2, 2}}}, 9), 1, 0.02f);
  const LightStream a = encode_light(grid).value(), b = encode_light(grid).value();
  EXPECT_EQ(parameters(a.layout), parameters(b.layout));
  ASSERT_EQ(a.bundles.size(), b.bundles.size());
  for (size_t i = 0; i < a.bundles.size(); i++) EXPECT_EQ(a.bundles[i].payload, b.bundles[i].payload);
}

TEST(LightStream, EveryPrefixCanBeDrawn) {
  const LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{4, 3, 2}}}, 11), 3);
  const LightStream stream = encode_light(grid, {.bundle_nodes = 64}).value();
  LightDecoder decoder = opened(stream);
  std::vector<uint8_t> before(grid.valid.size(), 0);
  for (const LightBundle& bundle : stream.bundles) {
    const LightGrid earlier = decoder.grid();
    ASSERT_TRUE(decoder.append(bundle.payload));
    for (size_t i = 0; i < before.size(); i++) {
      if (before[i]) {
        EXPECT_EQ(decoder.grid().moments[i].m, earlier.moments[i].m);
      }
      EXPECT_EQ(max_component(decoder.grid().moments[i].m[0]) > 0, decoder.known()[i] != 0);
    }
    before.assign(decoder.known().begin(), decoder.known().end());
  }
}

TEST(LightStream, TruncatedBundlesLeaveTheStateAsItWas) {
  const LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{4, 3, 2}}}, 9), 3, 0.03f, true);
  const LightStream stream = encode_light(grid, {.bundle_nodes = 64}).value();
  LightDecoder decoder = opened(stream);
  ASSERT_TRUE(decoder.append(stream.bundles[0].payload));
  const std::vector<uint8_t> known(decoder.known().begin(), decoder.known().end());
  const std::vector<uint8_t>& whole = stream.bundles[1].payload;
  // The last four bytes only end the coder's last word: a prefix without them may still decode, and then rightly.
  for (size_t length = 0; length + 4 < whole.size(); length++) {
    ASSERT_FALSE(decoder.append(Bytes(whole).first(length))) << length;
    EXPECT_TRUE(std::equal(known.begin(), known.end(), decoder.known().begin()));
  }
  for (size_t i = 1; i < stream.bundles.size(); i++) ASSERT_TRUE(decoder.append(stream.bundles[i].payload));
  for (size_t i = 0; i < grid.moments.size(); i++) {
    const Moments expected = decode_record(encode_record(grid.moments[i] * stream.layout.scale, grid.valid[i]));
    ASSERT_EQ(decoder.grid().moments[i].m, (expected * (1 / stream.layout.scale)).m);
  }
}

TEST(LightStream, SurvivesCorruption) {
  const LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{4, 3, 2}}}, 9), 3, 0.03f, true);
  const LightStream stream = encode_light(grid, {.bundle_nodes = 64}).value();
  Random random(4, 0);
  for (int i = 0; i < 200; i++) {
    LightDecoder decoder = opened(stream);
    for (const LightBundle& bundle : stream.bundles) {
      std::vector<uint8_t> payload = bundle.payload;
      if (random.below(3) == 0)
        payload[random.below(static_cast<uint32_t>(payload.size()))] ^= static_cast<uint8_t>(1 << random.below(8));
      if (!decoder.append(payload)) break;
    }
    for (const Moments& m : decoder.grid().moments) {
      for (const Vec3f& v : m.m) ASSERT_TRUE(is_finite(v));
    }
  }
}

TEST(LightLayout, RefusesWhatNoEncoderWrites) {
  const LightGrid grid = lamp_grid(GridShape{}, 1);
  const LightLayout good = encode_light(grid)->layout;
  const std::vector<uint8_t> bytes = parameters(good);
  EXPECT_TRUE(LightLayout::read(bytes));
  for (size_t length = 0; length < bytes.size(); length++) EXPECT_FALSE(LightLayout::read(Bytes(bytes).first(length)));

  const auto refused = [&](const auto& change) {
    LightLayout layout = good;
    change(layout);
    return !LightLayout::read(parameters(layout));
  };
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(refused([](LightLayout& l) { l.shape.nodes[1] = 1; }));
  EXPECT_TRUE(refused([](LightLayout& l) { l.shape.nodes[2] = 257; }));
  EXPECT_TRUE(refused([](LightLayout& l) { l.shape.nodes = {{256, 256, 256}}; }));
  EXPECT_TRUE(refused([](LightLayout& l) { l.shape.cell[0] = 0; }));
  EXPECT_TRUE(refused([&](LightLayout& l) { l.shape.cell[0] = nan; }));
  EXPECT_TRUE(refused([&](LightLayout& l) { l.shape.cell[0] = infinity; }));
  EXPECT_TRUE(refused([&](LightLayout& l) { l.shape.lo[1] = nan; }));
  EXPECT_TRUE(refused([](LightLayout& l) { l.nodes_per_slice = 0; }));
  EXPECT_TRUE(refused([](LightLayout& l) { l.nodes_per_slice = 2000; }));
  EXPECT_TRUE(refused([&](LightLayout& l) { l.normal_offset = nan; }));
  EXPECT_TRUE(refused([](LightLayout& l) { l.scale = 3; }));
  EXPECT_TRUE(refused([](LightLayout& l) { l.scale = 0; }));
  EXPECT_TRUE(refused([](LightLayout& l) { l.scale = 0x1p20f; }));
}

TEST(LightStream, RefusesGridsBeyondTheLimits) {
  LightGrid grid;
  grid.shape.nodes = {{300, 2, 2}};
  grid.moments.resize(grid.shape.count());
  grid.valid.assign(grid.shape.count(), 1);
  EXPECT_FALSE(encode_light(grid));
}

// Dark light costs next to nothing, so that the encoder has to pad it.
TEST(LightStream, ABytesWorthOfNodesIsLimited) {
  LightGrid grid;
  grid.shape.nodes = {{32, 32, 32}};
  grid.moments.resize(grid.shape.count());
  grid.valid.assign(grid.shape.count(), 1);
  const LightStream stream = encode_light(grid).value();
  const uint64_t least = (grid.shape.count() - 8) / light_nodes_per_byte;
  EXPECT_GE(stream_bytes(stream), least);
  EXPECT_LT(stream_bytes(stream), least + least / 10) << "nothing but padding";
  EXPECT_TRUE(LightDecoder::open(parameters(stream.layout), least));
  EXPECT_FALSE(LightDecoder::open(parameters(stream.layout), least - 1));
}

// The estimate falls to zero, and half way it is the true error of the same expectation within a factor of two: it is
// drawn from one bundle of nodes.
TEST(LightStream, EstimatesTheErrorThatRemains) {
  const LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{4, 4, 4}}}, 16), 3);
  const LightStream stream = encode_light(grid).value();
  for (size_t i = 1; i < stream.bundles.size(); i++) EXPECT_LE(stream.bundles[i].error, stream.bundles[i - 1].error);
  EXPECT_EQ(stream.bundles.back().error, 0);
  EXPECT_GT(stream.bundles.front().error, 0.02f);

  const size_t half = stream.bundles.size() / 2;
  LightDecoder decoder = opened(stream);
  for (size_t i = 0; i <= half; i++) ASSERT_TRUE(decoder.append(stream.bundles[i].payload));
  RecordField field(grid.shape);
  double error = 0, value = 0;
  for (size_t i = 0; i < grid.moments.size(); i++) {
    if (decoder.known()[i]) field.set(i, encode_record(grid.moments[i] * stream.layout.scale, true));
  }
  for (size_t i = 0; i < grid.moments.size(); i++) {
    for (size_t d = 0; d < 6; d++) value += dot(grid.moments[i].m[d], grid.moments[i].m[d]);
    if (decoder.known()[i]) continue;
    const RecordExpectation expected = field.expect(field.neighbours(i), true);
    for (size_t d = 0; d < 6; d++) {
      for (size_t c = 0; c < 3; c++) {
        const double guess = static_cast<double>(expected.irradiance[d][c]) * 0x1p-24 / stream.layout.scale;
        error += std::pow(guess - grid.moments[i].m[d][static_cast<int>(c)], 2);
      }
    }
  }
  const double ratio = stream.bundles[half].error / std::sqrt(error / value);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2);
}

// 33-byte records; the residuals of smooth light cost less than half of them.
TEST(LightStream, CompressesSmoothLight) {
  const LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{4, 4, 4}}}, 32), 3);
  const LightStream stream = encode_light(grid).value();
  size_t bytes = 0;
  for (const LightBundle& bundle : stream.bundles) bytes += bundle.payload.size();
  const double per_node = static_cast<double>(bytes) / static_cast<double>(grid.moments.size());
  RecordProperty("bytes_a_node", std::to_string(per_node));
  EXPECT_LT(per_node, 16.5);
}

}  // namespace
}  // namespace lightwell
