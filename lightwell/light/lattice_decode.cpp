// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/model_coder.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/stream_head.h"

namespace lightwell {
namespace {

Result<void> check(const LatticeLayout& layout) {
  LW_CHECK(check_head(layout.shape, layout.normal_offset, layout.scale));
  if (layout.steps < LatticeSteps::least || layout.steps > LatticeSteps::most ||
      (layout.steps & (layout.steps - 1)) != 0)
    return fail("light parameters", "number of steps is not a power of two from 4 to 256");
  return {};
}

bool read_corners(LatticeLayout& layout, Bytes bytes) {
  const LatticeSteps steps(layout.steps, layout.scale);
  ModelReader reader(bytes);
  LatticeCoder coder;
  LatticeValue before{.v = {}, .valid = true};
  for (LatticeValue& corner : layout.corners) {
    const LatticeValue* parent = &before;
    coder.code(reader, corner, LatticeExpectation({&parent, 1}), steps);
    before = corner;
  }
  return !reader.overrun();
}

}  // namespace

Result<LatticeLayout> LatticeLayout::read(Bytes parameters) {
  ByteReader reader(parameters);
  LatticeLayout layout;
  layout.shape = read_shape(reader);
  layout.steps = reader.u16();
  layout.normal_offset = reader.f32();
  layout.scale = reader.f32();
  const uint32_t brick_bytes = reader.u32();
  if (!reader.ok() || brick_bytes > reader.remaining()) return fail("light parameters", "wrong length");
  const Bytes bricks = reader.take(brick_bytes);
  const Bytes corners = reader.take(reader.remaining());
  LW_CHECK(check(layout));
  layout.tree = BrickTree(layout.shape.cells());
  if (!bricks.empty()) {
    auto tree = BrickTree::read(layout.shape.cells(), bricks, most_bricks);
    if (!tree) return fail("light parameters", "the bricks are damaged");
    layout.tree = std::move(*tree);
  }
  if (!read_corners(layout, corners)) return fail("light parameters", "wrong length");
  return layout;
}

LatticeDecoder::LatticeDecoder(LatticeLayout layout)
    : layout_(std::move(layout)),
      steps_(layout_.steps, layout_.scale),
      field_(layout_),
      coder_(std::make_unique<LatticeCoder>()) {}

Result<LatticeDecoder> LatticeDecoder::open(Bytes parameters, uint64_t stream_bytes) {
  LW_TRY(layout, LatticeLayout::read(parameters));
  // A brick has at least the 26 nodes that lie within it.
  constexpr uint64_t least_nodes_a_brick = 26;
  const uint64_t nodes =
      layout.shape.count() - layout.corners.size() + least_nodes_a_brick * layout.tree.bricks().size();
  if (nodes / light_nodes_per_byte > stream_bytes)
    return fail("light parameters", "promise more nodes than the stream's bytes can hold");
  return LatticeDecoder(std::move(layout));
}

Result<void> LatticeDecoder::append(Bytes payload) {
  if (complete()) return fail("light bundle", "the grid is complete already");
  const LatticeBundle bundle = LatticeBundle::next(field_, base_, bricks_);
  auto coder = std::make_unique<LatticeCoder>(*coder_);
  ModelReader reader(payload);
  for (size_t i = base_; i < base_ + bundle.base; i++) {
    const LatticeNode& place = field_.order()[i];
    coder->code(reader, field_.node(place.node), field_.expect(place), steps_);
  }
  for (uint32_t brick = bricks_; brick < bricks_ + bundle.bricks; brick++)
    field_.set_brick(brick, [&](LatticeValue& value, const LatticeExpectation& expected, int) {
      coder->code(reader, value, expected, steps_);
    });
  // What has been set will be set again by the bundle that is whole.
  if (reader.overrun()) return fail("light bundle", "ends too early");
  base_ += bundle.base;
  bricks_ += bundle.bricks;
  nodes_ = field_.nodes().first()[bricks_];
  coder_ = std::move(coder);
  return {};
}

LightGrid LatticeDecoder::grid(Fill fill) const {
  LightGrid grid;
  grid.shape = layout_.shape;
  grid.normal_offset = layout_.normal_offset;
  grid.moments.resize(grid.shape.count());
  grid.valid.assign(grid.shape.count(), 1);
  const std::vector<LatticeValue> values = field_.values(base_);
  for (size_t i = 0; i < field_.order().size(); i++) {
    if (i >= base_ && fill == Fill::none) break;
    const uint32_t node = field_.order()[i].node;
    grid.valid[node] = values[node].valid;
    grid.moments[node] = steps_.decode(values[node]);
  }
  place_bricks(grid);
  return grid;
}

void LatticeDecoder::place_bricks(LightGrid& grid) const {
  grid.tree = BrickTree(layout_.tree.cells());
  for (uint32_t brick = 0; brick < bricks_; brick++) grid.tree.add(layout_.tree.bricks()[brick]);
  grid.bricks.resize(bricks_);
  for (uint32_t brick = 0; brick < bricks_; brick++) {
    BrickPoints nodes;
    for (const int point : field_.finer()) {
      const LatticeValue& value = field_.point(brick, point);
      nodes[static_cast<size_t>(point)] = {steps_.decode(value), node_weight(value.valid)};
    }
    place_brick(grid, brick, nodes);
  }
}

}  // namespace lightwell
