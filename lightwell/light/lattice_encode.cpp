// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/base/model_coder.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/stream_head.h"

namespace lightwell {
namespace {

Result<void> check(const LightGrid& grid) {
  for (const int n : grid.shape.nodes.e) {
    if (n < 2 || n > LightLayout::most_nodes_an_axis)
      return fail("light grid", "an axis has " + std::to_string(n) + " nodes, not 2 to " +
                                    std::to_string(LightLayout::most_nodes_an_axis));
  }
  if (grid.shape.count() > LatticeLayout::most_nodes)
    return fail(ErrorKind::limit, "light grid", "more than " + std::to_string(LatticeLayout::most_nodes) + " nodes");
  if (grid.bricks.size() > LatticeLayout::most_bricks)
    return fail(ErrorKind::limit, "light grid", "more than " + std::to_string(LatticeLayout::most_bricks) + " bricks");
  LW_ASSERT(grid.moments.size() == grid.shape.count() && grid.valid.size() == grid.shape.count());
  return {};
}

/// The number of each brick of `tree` in the grid.
std::vector<uint32_t> numbers_in(const LightGrid& grid, const BrickTree& tree) {
  std::vector<uint32_t> numbers;
  for (const Brick& brick : tree.bricks()) numbers.push_back(*grid.tree.find(brick));
  return numbers;
}

/// The squared difference of two lights over all of their moments.
double squared_difference(const Moments& a, const Moments& b) {
  double sum = 0;
  for (size_t i = 0; i < a.m.size(); i++) sum += static_cast<double>(dot(a.m[i] - b.m[i], a.m[i] - b.m[i]));
  return sum;
}

/// Encodes the bundles in order and adds up what each of them mends.
class BundleEncoder {
 public:
  BundleEncoder(const LightGrid& grid, const LatticeLayout& layout)
      : grid_(grid),
        field_(layout),
        numbers_(numbers_in(grid, layout.tree)),
        tree_(layout.tree),
        linked_(!layout.links.empty()) {}

  std::vector<LightBundle> encode() {
    std::vector<LightBundle> bundles;
    std::vector<double> mended;
    for (size_t base = 8; base < field_.order().size() || brick_ < numbers_.size();) {
      const LatticeBundle bundle = LatticeBundle::next(field_, base, brick_);
      mended_ = 0;
      ModelWriter writer;
      const uint32_t first = field_.nodes().first()[brick_];
      for (size_t i = base; i < base + bundle.base; i++) encode_node(writer, field_.order()[i]);
      for (uint32_t i = 0; i < bundle.bricks; i++) encode_brick(writer);
      base += bundle.base;
      const auto nodes = static_cast<uint32_t>(bundle.base) + field_.nodes().first()[brick_] - first;
      bundles.push_back({.payload = writer.finish(), .nodes = nodes});
      std::vector<uint8_t>& payload = bundles.back().payload;
      payload.resize(std::max<size_t>(payload.size(), (nodes + light_nodes_per_byte - 1) / light_nodes_per_byte));
      mended.push_back(mended_);
    }
    // What is missing errs at least as much as its own bundles will mend; parents that are missing too add to it.
    double left = 0;
    for (size_t i = bundles.size(); i > 0; i--) {
      bundles[i - 1].error = whole_ > 0 ? static_cast<float>(std::min(1.0, std::sqrt(left / whole_))) : 0;
      left += mended[i - 1];
    }
    return bundles;
  }

 private:
  void encode_node(ModelWriter& writer, const LatticeNode& place) {
    encode_light(writer, field_.node(place.node), grid_.moments[place.node], grid_.valid[place.node] != 0,
                 field_.expect(place), 1);
  }

  void encode_brick(ModelWriter& writer) {
    const uint32_t number = numbers_[brick_];
    const double size = std::ldexp(1.0, -3 * tree_.bricks()[brick_].level);
    field_.set_brick(brick_, [&](std::span<int32_t> numbers, LatticeParents& parents, int point) {
      if (linked_) encode_links(writer, grid_.links.bricks[number], parents, point);
      const BrickPoint& light = grid_.bricks[number][static_cast<size_t>(point)];
      encode_light(writer, numbers, light.moments, light.weight > node_weight(false),
                   LatticeExpectation(field_.record(), parents), size);
    });
    brick_++;
  }

  void encode_links(ModelWriter& writer, const Links::Points& links, LatticeParents& parents, int point) {
    const std::vector<BrickParent>& around = brick_parents(point);
    for (size_t i = 0; i < around.size(); i++)
      parents.all()[i].blocked = (links[static_cast<size_t>(around[i].first)] >> around[i].axis & 1) != 0;
    coder_.code_links(writer, parents, field_.record().numbers().size());
  }

  void encode_light(ModelWriter& writer, std::span<int32_t> numbers, const Moments& moments, bool valid,
                    const LatticeExpectation& expected, double size) {
    if (valid) {
      expected.fill(numbers);  // what was shown before
      whole_ += size * squared_difference(moments, {});
      mended_ += size * squared_difference(moments, field_.record().decode(numbers));
      encode_numbers(field_.record(), moments, numbers);
    }
    numbers.back() = valid;
    coder_.code(writer, field_.record(), numbers, expected);
  }

  const LightGrid& grid_;
  LatticeField field_;
  LatticeCoder coder_;
  const std::vector<uint32_t> numbers_;
  const BrickTree& tree_;
  const bool linked_;
  uint32_t brick_ = 0;
  double mended_ = 0, whole_ = 0;
};

/// The corners, each told by how it differs from the one before.
std::vector<uint8_t> write_corners(const LatticeLayout& layout) {
  const std::unique_ptr<const LatticeRecord> record = layout.make_record();
  ModelWriter writer;
  LatticeCoder coder;
  LatticeNumbers corners = layout.corners, first(1, record->numbers().size());
  first[0].back() = 1;
  std::span<int32_t> before = first[0];
  for (size_t i = 0; i < 8; i++) {
    LatticeParents parents;
    parents.add({before.data()});
    coder.code(writer, *record, corners[i], LatticeExpectation(*record, parents));
    before = corners[i];
  }
  return writer.finish();
}

/// The corners' numbers. Of an invalid one they are those of the valid one before.
LatticeNumbers corners_of(const LightGrid& grid, const LatticeRecord& record) {
  const std::array<size_t, 8> nodes = corner_nodes(grid.shape);
  LatticeNumbers corners(nodes.size(), record.numbers().size()), before(1, record.numbers().size());
  for (size_t i = 0; i < nodes.size(); i++) {
    if (grid.valid[nodes[i]]) encode_numbers(record, grid.moments[nodes[i]], before[0]);
    std::ranges::copy(before[0], corners[i].begin());
    corners[i].back() = grid.valid[nodes[i]];
  }
  return corners;
}

}  // namespace

void LatticeLayout::write(ByteWriter& writer) const {
  write_head(writer);
  const std::vector<uint8_t> bricks = tree.empty() ? std::vector<uint8_t>() : tree.write();
  writer.u32(static_cast<uint32_t>(bricks.size()));
  writer.append(bricks);
  if (!links.empty()) {
    writer.u32(static_cast<uint32_t>(links.size()));
    writer.append(links);
  }
  writer.append(write_corners(*this));
}

int steps_for(const LightGrid& grid) {
  constexpr float hiding = 0.025f;
  return grid.noise > hiding ? 16 : 32;
}

Result<LatticeStream> encode_lattice(const LightGrid& grid, const LatticeStreamOptions& options) {
  LW_CHECK(check(grid));
  LatticeStream stream;
  LatticeLayout& layout = stream.layout;
  layout.shape = grid.shape;
  layout.normal_offset = grid.normal_offset;
  layout.scale = light_scale(grid);
  layout.record = options.record;
  layout.steps = options.steps > 0 ? options.steps : steps_for(grid);
  layout.tree = grid.tree.ordered();
  layout.links = write_links(grid);
  layout.corners = corners_of(grid, *layout.make_record());
  stream.bundles = BundleEncoder(grid, layout).encode();
  return stream;
}

}  // namespace lightwell
