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

// Axes are divided unevenly: the middle of 0 and 5 is 2. Numbers are told as floats, so that only rounding is left.
TEST(LatticeStream, WhatIsMissingOfAnEvenSlopeIsOnIt) {
  LightGrid grid;
  grid.shape = {.lo = {}, .cell = Vec3f::filled(1), .nodes = {{6, 9, 13}}};
  grid.valid.assign(grid.shape.count(), 1);
  for (size_t i = 0; i < grid.shape.count(); i++) {
    const Vec3f p = grid.shape.node(i).cast<float>();
    Moments light;
    for (Vec3f& m : light.m) m = Vec3f{{1 + p[0], 2 + 0.5f * p[1], 3 + 0.25f * p[2] + 0.125f * p[0]}};
    grid.moments.push_back(light);
  }
  const LatticeStream stream = encode_lattice(grid, {.record = LightRecord::floats}).value();
  LatticeDecoder decoder = opened(stream);
  for (const LightBundle& bundle : stream.bundles) {
    const LightGrid shown = decoder.grid(Fill::push_pull);
    for (size_t i = 0; i < grid.shape.count(); i++)
      for (size_t k = 0; k < 9; k++)
        for (int c = 0; c < 3; c++) ASSERT_NEAR(shown.moments[i].m[k][c], grid.moments[i].m[k][c], 1e-5f) << i;
    ASSERT_TRUE(decoder.append(bundle.payload));
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

// Finer steps than a grid's own noise only spell that out. 32 to an octave add 0.7 % of error, 16 twice that, by their
// rounding alone: at most half of the noise with which they are taken, that is 12 % of what noise and they make
// together.
TEST(LatticeStream, StepsFollowTheNoiseOfTheGrid) {
  LightGrid grid = lamp_grid(GridShape::over({{{0, 0, 0}}, {{3, 3, 2}}}, 17), 3, 0.06f);
  int before = 1 << 10;
  uint64_t bytes = std::numeric_limits<uint64_t>::max();
  for (const float noise : {0.0f, 0.005f, 0.015f, 0.024f, 0.026f, 0.05f, 0.2f, 1.0f}) {
    grid.noise = noise;
    const LatticeStream stream = encode_lattice(grid).value();
    EXPECT_EQ(stream.layout.steps, noise > 0.025f ? 16 : 32) << noise;
    EXPECT_LE(stream.layout.steps, before) << noise;
    EXPECT_LE(stream_bytes(stream), bytes) << noise;
    const double added = difference(grid, decoded(stream).grid(Fill::push_pull));
    EXPECT_LT(added, std::max(0.0075, 0.5 * static_cast<double>(noise))) << noise;
    before = stream.layout.steps;
    bytes = stream_bytes(stream);
  }
  EXPECT_EQ(encode_lattice(grid, {.steps = 64}).value().layout.steps, 64) << "what is asked for is taken";
}

/// A grid divided by a wall at half of its width: bright on one side, darker and of another colour on the other. Its
/// links say where the wall stands.
LightGrid two_rooms(uint64_t seed) {
  Random random(seed, 0);
  GridShape shape = divisible_shape(random);
  shape.nodes[0] = 17;
  const float wall = shape.lo[0] + 7.3f * shape.cell[0];
  BrickTree tree(shape.cells());
  for (int y = 0; 2 * y + 1 < shape.nodes[1] - 1; y++) tree.add({1, {{3, y, 0}}});
  LightGrid grid = grid_of_field(shape, tree, [&](const Vec3f& p) {
    const Vec3f radiance = p[0] < wall ? Vec3f{{3, 2, 1}} : Vec3f{{0.1f, 0.2f, 0.4f}};
    return std::pair(uniform_light(radiance * (1 + 0.05f * p[1])), true);
  });
  const auto link = [&](const Vec3f& from, const Vec3f& cell) {
    return static_cast<uint8_t>(from[0] < wall && from[0] + cell[0] > wall);
  };
  for (size_t i = 0; i < shape.count(); i++)
    grid.links.nodes.push_back(link(shape.position(shape.node(i)), shape.cell));
  for (const Brick& brick : tree.bricks()) {
    const Vec3f cell = shape.cell * std::ldexp(1.0f, -brick.level);
    Links::Points links{};
    for (int point = 0; point < Brick::points; point++)
      if (Brick::local(point)[0] < Brick::cells)
        links[static_cast<size_t>(point)] = link(shape.lo + cell * brick.corner(point).cast<float>(), cell);
    grid.links.bricks.push_back(links);
  }
  return grid;
}

// The wall costs bytes only where it is told, and what lies behind it is no longer mixed in: without links half of a
// room is a mixture of both until the finest nodes have come.
TEST(LatticeStream, DoesNotLookThroughWalls) {
  for (uint64_t seed = 0; seed < 4; seed++) {
    const LightGrid linked = two_rooms(seed);
    LightGrid unlinked = linked;
    unlinked.links = {};
    const LatticeStream with = encode_lattice(linked).value(), without = encode_lattice(unlinked).value();
    EXPECT_LT(stream_bytes(with) + with.layout.links.size(), stream_bytes(without));
    const LightGrid shown = opened(with).grid(Fill::push_pull), mixed = opened(without).grid(Fill::push_pull);
    EXPECT_LT(difference(linked, shown), 0.1) << "the corners alone know both rooms";
    EXPECT_GT(difference(linked, mixed), 0.3);
  }
}

TEST(LatticeStream, ReturnsTheLinks) {
  for (uint64_t seed = 0; seed < 4; seed++) {
    const LightGrid grid = two_rooms(seed);
    const LightGrid back = decoded(encode_lattice(grid).value()).grid(Fill::push_pull);
    EXPECT_EQ(back.links.nodes, grid.links.nodes);
    // Of bricks those from their own nodes to their parents.
    ASSERT_EQ(back.links.bricks.size(), grid.bricks.size());
    size_t blocked = 0;
    for (uint32_t brick = 0; brick < grid.bricks.size(); brick++)
      for (size_t point = 0; point < Brick::points; point++) {
        EXPECT_EQ(back.links.bricks[brick][point] & ~grid.links.bricks[brick][point], 0);
        blocked += back.links.bricks[brick][point];
      }
    EXPECT_GT(blocked, 0u);
  }
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
