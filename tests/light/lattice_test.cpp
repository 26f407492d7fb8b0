// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "lightwell/light/lattice_stream.h"
#include "tests/light/brick_fields.h"
#include "tests/light/stream_parts.h"

namespace lightwell {
namespace {

LatticeDecoder opened(const LatticeStream& stream) {
  return std::move(LatticeDecoder::open(parameters(stream.layout), stream_bytes(stream)).value());
}

LatticeDecoder decoded(const LatticeStream& stream) {
  LatticeDecoder decoder = opened(stream);
  for (const LightBundle& bundle : stream.bundles) EXPECT_TRUE(decoder.append(bundle.payload));
  return decoder;
}

/// The root mean square difference of two lights over all moments, as a share of the first one's.
double difference(const LightGrid& a, const LightGrid& b) {
  double squares = 0, size = 0;
  const auto add = [&](const Moments& x, const Moments& y) {
    for (size_t i = 0; i < 6; i++) {
      squares += static_cast<double>(dot(x.m[i] - y.m[i], x.m[i] - y.m[i]));
      size += static_cast<double>(dot(x.m[i], x.m[i]));
    }
  };
  for (size_t i = 0; i < a.moments.size(); i++)
    if (a.valid[i]) add(a.moments[i], b.moments[i]);
  for (size_t brick = 0; brick < std::min(a.bricks.size(), b.bricks.size()); brick++)
    for (size_t point = 0; point < Brick::points; point++)
      if (a.bricks[brick][point].weight > node_weight(false))
        add(a.bricks[brick][point].moments, b.bricks[brick][point].moments);
  return std::sqrt(squares / size);
}

TEST(LatticeOrder, ComesToEveryNodeOnceAfterItsParents) {
  Random random(1, 0);
  for (int i = 0; i < 30; i++) {
    const GridShape shape = random_shape(random, 12);
    const std::vector<LatticeNode> order = lattice_order(shape.nodes);
    std::set<uint32_t> seen;
    for (const LatticeNode& node : order) {
      EXPECT_EQ(node.parent_count == 0, seen.size() < 8);
      Vec3f middle{};
      for (size_t p = 0; p < node.parent_count; p++) {
        EXPECT_TRUE(seen.contains(node.parents[p]));
        middle += shape.node(node.parents[p]).cast<float>() / static_cast<float>(node.parent_count);
      }
      EXPECT_TRUE(seen.insert(node.node).second);
      // Bisection halves a gap up to a node.
      for (int a = 0; node.parent_count > 0 && a < 3; a++)
        EXPECT_NEAR(middle[a], static_cast<float>(shape.node(node.node)[a]), 0.5f);
    }
    EXPECT_EQ(seen.size(), shape.count());
    const std::array<size_t, 8> corners = corner_nodes(shape);
    for (size_t k = 0; k < 8; k++) EXPECT_EQ(order[k].node, corners[k]);
  }
}

// A step of 1/32 of an octave rounds by at most 1.1 %, evenly: 0.63 % in root mean square, and what is added to E so
// that its logarithm ends makes more of it in the dark only.
TEST(LatticeSteps, RoundToHalfAStep) {
  Random random(3, 0);
  const LatticeSteps steps(32, 1);
  for (int i = 0; i < 300; i++) {
    Moments m = uniform_light(random_colour(random) * 100);
    m += parallel_light(random_direction(random), random_colour(random) * 300);
    const Moments back = steps.decode(steps.encode(m));
    for (size_t d = 0; d < 6; d++)
      for (int c = 0; c < 3; c++) EXPECT_NEAR(back.m[d][c], m.m[d][c], 0.0112f * (m.m[d][c] + 0.0625f));
    const LatticeValue again = steps.encode(back);
    for (size_t k = 0; k < 18; k++) EXPECT_EQ(again.v[k], steps.encode(m).v[k]) << "decoding is exact";
  }
}

TEST(LatticeSteps, AnyValueIsFinite) {
  Random random(4, 0);
  for (const int count : {4, 32, 256}) {
    const LatticeSteps steps(count, 0x1p15f);
    for (int i = 0; i < 300; i++) {
      LatticeValue value;
      for (int16_t& v : value.v) v = static_cast<int16_t>(random.bits());
      for (const Vec3f& m : steps.decode(value).m) EXPECT_TRUE(is_finite(m));
    }
  }
}

TEST(LatticeStream, ReturnsWhatItsStepsRoundTo) {
  for (uint64_t seed = 0; seed < 12; seed++) {
    LightGrid grid = bricked_grid(seed, seed % 3 == 0 ? 0 : 20);
    grid.normal_offset = 0.375f;
    const LatticeStream stream = encode_lattice(grid).value();
    LatticeDecoder decoder = opened(stream);
    for (const LightBundle& bundle : stream.bundles) {
      ASSERT_FALSE(decoder.complete());
      const size_t before = decoder.received();
      ASSERT_TRUE(decoder.append(bundle.payload));
      EXPECT_EQ(decoder.received(), before + bundle.nodes);
    }
    ASSERT_TRUE(decoder.complete());
    EXPECT_FALSE(decoder.append(Bytes{}));
    const LightGrid back = decoder.grid(Fill::push_pull);
    EXPECT_EQ(back.valid, grid.valid);
    EXPECT_EQ(back.normal_offset, grid.normal_offset);
    EXPECT_EQ(back.shape, grid.shape);
    EXPECT_TRUE(std::ranges::equal(back.tree.bricks(), grid.tree.bricks()));
    for (size_t brick = 0; brick < grid.bricks.size(); brick++)
      for (size_t point = 0; point < Brick::points; point++)
        EXPECT_EQ(back.bricks[brick][point].weight, grid.bricks[brick][point].weight);
    EXPECT_LT(difference(grid, back), 0.008);
  }
}

/// The root mean square difference of lookups all over two grids, as a share of the first one's.
double lookup_difference(const LightGrid& a, const LightGrid& b) {
  Random random(3, 0);
  double squares = 0, size = 0;
  for (int i = 0; i < 2000; i++) {
    const Vec3f p = a.shape.lo + (a.shape.hi() - a.shape.lo) * random_colour(random), n = random_direction(random);
    const Vec3f light = a.irradiance(p, n), difference = light - b.irradiance(p, n);
    squares += static_cast<double>(dot(difference, difference));
    size += static_cast<double>(dot(light, light));
  }
  return std::sqrt(squares / size);
}

// Each further bundle brings what is shown nearer to the whole: halfway at most half of what the corners alone leave.
TEST(LatticeStream, AnyPrefixIsAGridBetweenWhatIsKnown) {
  for (uint64_t seed = 0; seed < 6; seed++) {
    const LightGrid grid = bricked_grid(seed, 20);
    const LatticeStream stream = encode_lattice(grid).value();
    LatticeDecoder decoder = opened(stream);
    const LightGrid whole = decoded(stream).grid(Fill::push_pull);
    double before = 10;
    for (const LightBundle& bundle : stream.bundles) {
      ASSERT_TRUE(decoder.append(bundle.payload));
      const LightGrid shown = decoder.grid(Fill::push_pull);
      const double error = lookup_difference(whole, shown);
      EXPECT_LE(error, 1.05 * before);
      before = error;
    }
    EXPECT_EQ(before, 0);
    EXPECT_EQ(stream.bundles.back().error, 0);
    for (size_t i = 1; i < stream.bundles.size(); i++) EXPECT_LE(stream.bundles[i].error, stream.bundles[i - 1].error);
  }
}

TEST(LatticeStream, IsTheSameEveryTime) {
  const LightGrid grid = bricked_grid(5);
  const LatticeStream a = encode_lattice(grid).value(), b = encode_lattice(grid).value();
  EXPECT_EQ(parameters(a.layout), parameters(b.layout));
  ASSERT_EQ(a.bundles.size(), b.bundles.size());
  for (size_t i = 0; i < a.bundles.size(); i++) EXPECT_EQ(a.bundles[i].payload, b.bundles[i].payload);
}

// Light of eight lamps at 12,000 nodes, quantised to 0.7 %: 6.4 bytes; S08's record takes 42.
TEST(LatticeStream, TakesFewBytesANode) {
  const LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{3, 3, 2}}}, 25), 2);
  const LatticeStream stream = encode_lattice(grid).value();
  EXPECT_LT(static_cast<double>(stream_bytes(stream)) / static_cast<double>(grid.shape.count()), 6.5);
}

TEST(LatticeStream, RefusesParametersThatNoEncoderWrites) {
  const LatticeStream stream = encode_lattice(bricked_grid(1)).value();
  const auto refused = [&](auto change) {
    LatticeLayout layout = stream.layout;
    change(layout);
    return !LatticeLayout::read(parameters(layout));
  };
  EXPECT_FALSE(refused([](LatticeLayout&) {}));
  EXPECT_TRUE(refused([](LatticeLayout& l) { l.shape.cell[1] = 0; }));
  EXPECT_TRUE(refused([](LatticeLayout& l) { l.shape.lo[0] = std::numeric_limits<float>::infinity(); }));
  EXPECT_TRUE(refused([](LatticeLayout& l) { l.normal_offset = 2; }));
  EXPECT_TRUE(refused([](LatticeLayout& l) { l.scale = 3; }));
  const std::vector<uint8_t> bytes = parameters(stream.layout);
  for (size_t length = 0; length < bytes.size() - 8; length++)
    EXPECT_FALSE(LatticeLayout::read(Bytes(bytes).first(length))) << length;
  std::vector<uint8_t> many = bytes;
  many[30] = 3;  // steps: not a power of two
  EXPECT_FALSE(LatticeLayout::read(many));
}

TEST(LatticeStream, PromisesNoMoreNodesThanItsBytesHold) {
  LightGrid grid = bricked_grid(2);
  const LatticeStream stream = encode_lattice(grid).value();
  const uint64_t nodes = LatticeField(stream.layout).count();
  EXPECT_TRUE(LatticeDecoder::open(parameters(stream.layout), stream_bytes(stream)));
  EXPECT_GE(light_nodes_per_byte * stream_bytes(stream), nodes - 8);
  EXPECT_FALSE(LatticeDecoder::open(parameters(stream.layout), grid.shape.count() / light_nodes_per_byte / 2));
}

TEST(LatticeStream, SurvivesDamage) {
  const LatticeStream stream = encode_lattice(bricked_grid(3, 30)).value();
  Random random(6, 0);
  for (int i = 0; i < 60; i++) {
    LatticeDecoder decoder = opened(stream);
    for (const LightBundle& bundle : stream.bundles) {
      std::vector<uint8_t> payload = bundle.payload;
      payload[random.below(static_cast<uint32_t>(payload.size()))] ^= static_cast<uint8_t>(1 + random.below(255));
      payload.resize(payload.size() - random.below(4) * payload.size() / 8);
      const size_t before = decoder.received();
      const bool taken = decoder.append(payload).has_value();
      EXPECT_EQ(decoder.received() > before, taken);
    }
    const LightGrid grid = decoder.grid(Fill::push_pull);
    for (const Moments& m : grid.moments)
      for (const Vec3f& v : m.m) ASSERT_TRUE(is_finite(v));
  }
}

}  // namespace
}  // namespace lightwell
