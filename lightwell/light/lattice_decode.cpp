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
  if (!bricks.empty()) layout.halvings = reader.u8();
  const Bytes links = (kind & links_bit) != 0 ? take_run() : Bytes{};
  if (!reader.ok() || ((kind & links_bit) != 0 && links.empty())) return fail("light parameters", "wrong length");
  const Bytes corners = reader.take(reader.remaining());
  LW_CHECK(check(layout));
  layout.links.assign(links.begin(), links.end());
  layout.tree = BrickTree(layout.shape.cells());
  if (!bricks.empty()) {
    auto tree = BrickTree::read(layout.shape.cells(), bricks, most_bricks);
    if (!tree || layout.halvings > BrickRegions::most_halvings)
      return fail("light parameters", "the bricks are damaged");
    BrickRegions split = BrickRegions::split(*tree, layout.halvings);
    layout.tree = std::move(split.tree);
    layout.regions = std::move(split.regions);
  }
  if (!read_corners(layout, corners)) return fail("light parameters", "wrong length");
  return layout;
}

Result<BricksLayout> BricksLayout::read(Bytes parameters) {
  ByteReader reader(parameters);
  BricksLayout layout;
  layout.grid = reader.u32();
  layout.region = reader.u32();
  if (!reader.ok() || reader.remaining() > 0) return fail("bricks parameters", "wrong length");
  return layout;
}

LatticeDecoder::LatticeDecoder(LatticeLayout layout)
    : layout_(std::move(layout)),
      field_(layout_),
      coder_(std::make_unique<LatticeCoder>()),
      regions_(layout_.regions.size()) {}

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
  if (base_ == field_.order().size()) return decode_bricks(0, payload);
  const size_t end = base_ + LatticeBundle::nodes(field_, base_);
  auto coder = std::make_unique<LatticeCoder>(*coder_);
  ModelReader reader(payload);
  for (size_t i = base_; i < end; i++) {
    constexpr size_t ahead = 3;
    field_.prefetch(i + ahead);
    const LatticeNode& place = field_.order()[i];
    coder->code(reader, field_.record(), field_.node(place.node), field_.expect(place));
  }
  // What has been set will be set again by the bundle that is whole.
  if (reader.overrun()) return fail("light bundle", "ends too early");
  base_ = end;
  coder_ = std::move(coder);
  return {};
}

Result<void> LatticeDecoder::append_bricks(size_t region, Bytes payload) {
  if (!layout_.apart() || !complete()) return fail("light bundle", "the grid's own nodes come first");
  if (complete(region)) return fail("light bundle", "the bricks are complete already");
  return decode_bricks(region, payload);
}

Result<void> LatticeDecoder::decode_bricks(size_t number, Bytes payload) {
  const BrickRegion& region = layout_.regions[number];
  Region& state = regions_[number];
  const uint32_t begin = region.begin + state.bricks, end = begin + LatticeBundle::bricks(field_, region, state.bricks);
  auto coder = std::make_unique<LatticeCoder>(state.coder ? *state.coder : *coder_);
  ModelReader reader(payload);
  for (uint32_t brick = begin; brick < end; brick++)
    field_.set_brick(brick, [&](std::span<int32_t> numbers, LatticeParents& parents, int) {
      if (!layout_.links.empty()) coder->code_links(reader, parents, numbers.size() - 1);
      coder->code(reader, field_.record(), numbers, LatticeExpectation(field_.record(), parents));
    });
  if (reader.overrun()) return fail("light bundle", "ends too early");
  state.bricks += end - begin;
  state.coder = std::move(coder);
  return {};
}

bool LatticeDecoder::complete() const {
  return base_ == field_.order().size() && (layout_.apart() || regions_.empty() || complete(0));
}

size_t LatticeDecoder::received(size_t region) const {
  const auto& first = field_.nodes().first();
  const uint32_t begin = layout_.regions[region].begin;
  return first[begin + regions_[region].bricks] - first[begin];
}

size_t LatticeDecoder::received() const {
  size_t nodes = base_;
  for (size_t region = 0; region < regions_.size(); region++) nodes += received(region);
  return nodes;
}

/// The bricks that are here, coarser ones before those inside of them.
std::vector<uint32_t> LatticeDecoder::arrived() const {
  std::vector<uint32_t> bricks;
  for (size_t region = 0; region < regions_.size(); region++)
    for (uint32_t i = 0; i < regions_[region].bricks; i++) bricks.push_back(layout_.regions[region].begin + i);
  return bricks;
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
  const std::vector<uint32_t> bricks = arrived();
  grid.tree = BrickTree(layout_.tree.cells());
  for (const uint32_t brick : bricks) grid.tree.add(layout_.tree.bricks()[brick]);
  grid.bricks.resize(bricks.size());
  for (uint32_t i = 0; i < bricks.size(); i++) {
    BrickPoints nodes;
    for (const int point : field_.finer()) {
      const std::span<const int32_t> numbers = field_.point(bricks[i], point);
      nodes[static_cast<size_t>(point)] = {field_.record().decode(numbers), node_weight(numbers.back() != 0)};
    }
    place_brick(grid, i, nodes);
  }
  const std::vector<Links::Points>& links = field_.links().bricks;
  if (links.empty()) return;
  for (const uint32_t brick : bricks) grid.links.bricks.push_back(links[brick]);
}

}  // namespace lightwell
