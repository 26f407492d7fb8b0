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
        steps_(layout.steps, layout.scale),
        field_(layout),
        numbers_(numbers_in(grid, layout.tree)),
        tree_(layout.tree) {}

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
    const Moments& moments = grid_.moments[place.node];
    const LatticeExpectation expected = field_.expect(place);
    LatticeValue value = steps_.encode(moments);
    value.valid = grid_.valid[place.node];
    count(value, expected, moments, 1);
    coder_.code(writer, value, expected, steps_);
    field_.node(place.node) = value;
  }

  void encode_brick(ModelWriter& writer) {
    const BrickPoints& points = grid_.bricks[numbers_[brick_]];
    const double size = std::ldexp(1.0, -3 * tree_.bricks()[brick_].level);
    field_.set_brick(brick_, [&](LatticeValue& value, const LatticeExpectation& expected, int point) {
      const BrickPoint& light = points[static_cast<size_t>(point)];
      value = steps_.encode(light.moments);
      value.valid = light.weight > node_weight(false);
      count(value, expected, light.moments, size);
      coder_.code(writer, value, expected, steps_);
    });
    brick_++;
  }

  void count(const LatticeValue& value, const LatticeExpectation& expected, const Moments& moments, double size) {
    if (!value.valid) return;
    whole_ += size * squared_difference(moments, {});
    mended_ += size * squared_difference(moments, steps_.decode(expected.value()));
  }

  const LightGrid& grid_;
  const LatticeSteps steps_;
  LatticeField field_;
  LatticeCoder coder_;
  const std::vector<uint32_t> numbers_;
  const BrickTree& tree_;
  uint32_t brick_ = 0;
  double mended_ = 0, whole_ = 0;
};

/// The corners, each told by how it differs from the one before.
std::vector<uint8_t> write_corners(const LatticeLayout& layout) {
  const LatticeSteps steps(layout.steps, layout.scale);
  ModelWriter writer;
  LatticeCoder coder;
  LatticeValue before{.v = {}, .valid = true};
  for (LatticeValue corner : layout.corners) {
    const LatticeValue* parent = &before;
    coder.code(writer, corner, LatticeExpectation({&parent, 1}), steps);
    before = corner;
  }
  return writer.finish();
}

}  // namespace

void LatticeLayout::write(ByteWriter& writer) const {
  write_shape(writer, shape);
  writer.u16(static_cast<uint16_t>(steps));
  writer.f32(normal_offset);
  writer.f32(scale);
  const std::vector<uint8_t> bricks = tree.empty() ? std::vector<uint8_t>() : tree.write();
  writer.u32(static_cast<uint32_t>(bricks.size()));
  writer.append(bricks);
  writer.append(write_corners(*this));
}

Result<LatticeStream> encode_lattice(const LightGrid& grid, const LatticeStreamOptions& options) {
  LW_CHECK(check(grid));
  LatticeStream stream;
  LatticeLayout& layout = stream.layout;
  layout.shape = grid.shape;
  layout.normal_offset = grid.normal_offset;
  layout.scale = light_scale(grid);
  layout.steps = options.steps;
  layout.tree = grid.tree.ordered();
  const LatticeSteps steps(layout.steps, layout.scale);
  const std::array<size_t, 8> corners = corner_nodes(grid.shape);
  LatticeValue before{.v = {}, .valid = true};
  for (size_t i = 0; i < corners.size(); i++) {
    LatticeValue& corner = layout.corners[i];
    if (grid.valid[corners[i]]) before = steps.encode(grid.moments[corners[i]]);
    corner = before;
    corner.valid = grid.valid[corners[i]];
  }
  stream.bundles = BundleEncoder(grid, layout).encode();
  return stream;
}

}  // namespace lightwell
