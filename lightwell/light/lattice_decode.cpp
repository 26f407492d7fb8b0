// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/model_coder.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/stream_head.h"

namespace lightwell {
namespace {

/// The bits of the field that has the number of steps, a power of two: above it the record, and whether links are told.
constexpr int steps_bits = 0x3ff, record_shift = 10, links_bit = 0x8000;

Result<void> check(const LatticeLayout& layout) {
  LW_CHECK(check_head(layout.shape, layout.normal_offset, layout.scale));
  if (layout.steps < least_steps || layout.steps > most_steps || (layout.steps & (layout.steps - 1)) != 0)
    return fail("light parameters", "number of steps is not a power of two from 4 to 256");
  if (static_cast<int>(layout.record) >= light_records)
    return fail(ErrorKind::unsupported, "light parameters", "the record is not known to this program");
  return {};
}

bool read_corners(LatticeLayout& layout, Bytes bytes) {
  const std::unique_ptr<const LatticeRecord> record = layout.make_record();
  layout.corners = LatticeNumbers(8, record->numbers().size());
  ModelReader reader(bytes);
  LatticeCoder coder;
  LatticeNumbers first(1, record->numbers().size());
  first[0].back() = 1;
  std::span<int32_t> before = first[0];
  for (size_t i = 0; i < 8; i++) {
    LatticeParents parents;
    parents.add({before.data()});
    coder.code(reader, *record, layout.corners[i], LatticeExpectation(*record, parents));
    before = layout.corners[i];
  }
  return !reader.overrun();
}

}  // namespace

void LatticeLayout::write_head(ByteWriter& writer) const {
  write_shape(writer, shape);
  writer.u16(static_cast<uint16_t>(steps | static_cast<int>(record) << record_shift | (links.empty() ? 0 : links_bit)));
  writer.f32(normal_offset);
  writer.f32(scale);
}

Result<LatticeLayout> LatticeLayout::read(Bytes parameters) {
  ByteReader reader(parameters);
  LatticeLayout layout;
  layout.shape = read_shape(reader);
  const int kind = reader.u16();
  layout.steps = kind & steps_bits;
  layout.record = static_cast<LightRecord>((kind & ~links_bit) >> record_shift);
  layout.normal_offset = reader.f32();
  layout.scale = reader.f32();
  const auto take_run = [&] {
    const uint32_t length = reader.u32();
    return reader.take(length);
  };
  const Bytes bricks = take_run();
  const Bytes links = (kind & links_bit) != 0 ? take_run() : Bytes{};
  if (!reader.ok() || ((kind & links_bit) != 0 && links.empty())) return fail("light parameters", "wrong length");
  const Bytes corners = reader.take(reader.remaining());
  LW_CHECK(check(layout));
  layout.links.assign(links.begin(), links.end());
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
    : layout_(std::move(layout)), field_(layout_), coder_(std::make_unique<LatticeCoder>()) {}

Result<LatticeDecoder> LatticeDecoder::open(Bytes parameters, uint64_t stream_bytes) {
  LW_TRY(layout, LatticeLayout::read(parameters));
  // A brick has at least the 26 nodes that lie within it.
  constexpr uint64_t least_nodes_a_brick = 26, corner_nodes = 8;
  const uint64_t nodes = layout.shape.count() - corner_nodes + least_nodes_a_brick * layout.tree.bricks().size();
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
    constexpr size_t ahead = 3;
    field_.prefetch(i + ahead);
    const LatticeNode& place = field_.order()[i];
    coder->code(reader, field_.record(), field_.node(place.node), field_.expect(place));
  }
  for (uint32_t brick = bricks_; brick < bricks_ + bundle.bricks; brick++)
    field_.set_brick(brick, [&](std::span<int32_t> numbers, LatticeParents& parents, int) {
      if (!layout_.links.empty()) coder->code_links(reader, parents, numbers.size() - 1);
      coder->code(reader, field_.record(), numbers, LatticeExpectation(field_.record(), parents));
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
  for (size_t i = 0; i < base_; i++) {
    const uint32_t node = field_.order()[i].node;
    const std::span<const int32_t> numbers = field_.node(node);
    grid.valid[node] = numbers.back() != 0;
    grid.moments[node] = field_.record().decode(numbers);
  }
  if (fill != Fill::none) field_.fill(grid, base_);
  place_bricks(grid);
  grid.links.nodes = field_.links().nodes;
  return grid;
}

void LatticeDecoder::place_bricks(LightGrid& grid) const {
  grid.tree = BrickTree(layout_.tree.cells());
  for (uint32_t brick = 0; brick < bricks_; brick++) grid.tree.add(layout_.tree.bricks()[brick]);
  grid.bricks.resize(bricks_);
  for (uint32_t brick = 0; brick < bricks_; brick++) {
    BrickPoints nodes;
    for (const int point : field_.finer()) {
      const std::span<const int32_t> numbers = field_.point(brick, point);
      nodes[static_cast<size_t>(point)] = {field_.record().decode(numbers), node_weight(numbers.back() != 0)};
    }
    place_brick(grid, brick, nodes);
  }
  const std::vector<Links::Points>& links = field_.links().bricks;
  if (!links.empty()) grid.links.bricks.assign(links.begin(), links.begin() + bricks_);
}

}  // namespace lightwell
