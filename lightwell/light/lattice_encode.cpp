// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numeric>

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
        layout_(layout),
        field_(layout),
        numbers_(numbers_in(grid, layout.tree)),
        linked_(!layout.links.empty()) {}

  void encode(LatticeStream& stream) {
    Bundles own;
    for (size_t done = 8; done < field_.order().size();) {
      const size_t nodes = LatticeBundle::nodes(field_, done);
      encode_bundle(own, static_cast<uint32_t>(nodes), [&](ModelWriter& writer) {
        for (size_t i = done; i < done + nodes; i++) encode_node(writer, field_.order()[i]);
      });
      done += nodes;
    }
    const LatticeCoder after_nodes = coder_;
    std::vector<Bundles> regions;
    for (const BrickRegion& region : layout_.regions) {
      if (layout_.apart()) {
        coder_ = after_nodes;
        regions.emplace_back();
      }
      encode_region(region, layout_.apart() ? regions.back() : own);
    }
    double of_regions = 0;
    for (const Bundles& region : regions) of_regions += region.mends();
    // What is missing errs at least as much as its own bundles will mend; parents that are missing too add to it.
    stream.bundles = own.take(of_regions, whole_);
    for (Bundles& region : regions) stream.regions.push_back(region.take(of_regions - region.mends(), whole_));
  }

 private:
  /// The bundles of a stream.
  class Bundles {
   public:
    void add(LightBundle bundle, double mended) {
      bundles_.push_back(std::move(bundle));
      mended_.push_back(mended);
    }
    double mends() const { return std::accumulate(mended_.begin(), mended_.end(), 0.0); }
    /// With their errors, when others still have so much of the whole to mend.
    std::vector<LightBundle> take(double left, double whole) {
      for (size_t i = bundles_.size(); i > 0; i--) {
        bundles_[i - 1].error = whole > 0 ? static_cast<float>(std::min(1.0, std::sqrt(left / whole))) : 0;
        left += mended_[i - 1];
      }
      return std::move(bundles_);
    }

   private:
    std::vector<LightBundle> bundles_;
    std::vector<double> mended_;
  };

  template <typename Encode>
  void encode_bundle(Bundles& bundles, uint32_t nodes, const Encode& encode) {
    mended_ = 0;
    ModelWriter writer;
    encode(writer);
    LightBundle bundle{.payload = writer.finish(), .nodes = nodes};
    const size_t least = (nodes + light_nodes_per_byte - 1) / light_nodes_per_byte;
    bundle.payload.resize(std::max(bundle.payload.size(), least));
    bundles.add(std::move(bundle), mended_);
  }

  void encode_region(const BrickRegion& region, Bundles& bundles) {
    const auto& first = field_.nodes().first();
    for (uint32_t brick = region.begin; brick < region.end;) {
      const uint32_t end = brick + LatticeBundle::bricks(field_, region, brick - region.begin);
      encode_bundle(bundles, first[end] - first[brick], [&](ModelWriter& writer) {
        for (; brick < end; brick++) encode_brick(writer, brick);
      });
    }
  }

  void encode_node(ModelWriter& writer, const LatticeNode& place) {
    encode_light(writer, field_.node(place.node), grid_.moments[place.node], grid_.valid[place.node] != 0,
                 field_.expect(place), 1);
  }

  void encode_brick(ModelWriter& writer, uint32_t brick) {
    const uint32_t number = numbers_[brick];
    const double size = std::ldexp(1.0, -3 * layout_.tree.bricks()[brick].level);
    field_.set_brick(brick, [&](std::span<int32_t> numbers, LatticeParents& parents, int point) {
      if (linked_) encode_links(writer, grid_.links.bricks[number], parents, point);
      const BrickPoint& light = grid_.bricks[number][static_cast<size_t>(point)];
      encode_light(writer, numbers, light.moments, light.weight > node_weight(false),
                   LatticeExpectation(field_.record(), parents), size);
    });
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
  const LatticeLayout& layout_;
  LatticeField field_;
  LatticeCoder coder_;
  const std::vector<uint32_t> numbers_;
  const bool linked_;
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
  if (!bricks.empty()) writer.u8(static_cast<uint8_t>(halvings));
  if (!links.empty()) {
    writer.u32(static_cast<uint32_t>(links.size()));
    writer.append(links);
  }
  writer.append(write_corners(*this));
}

void BricksLayout::write(ByteWriter& writer) const {
  writer.u32(grid);
  writer.u32(region);
}

int halvings_for(const LightGrid& grid) {
  constexpr size_t most_nodes = 16384;
  size_t nodes = BrickNodes(grid.tree).nodes().size();
  int halvings = 0;
  for (; nodes > most_nodes && halvings < BrickRegions::most_halvings; nodes /= 2) halvings++;
  return halvings;
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
  layout.halvings = options.halvings >= 0 ? options.halvings : halvings_for(grid);
  BrickRegions split = BrickRegions::split(grid.tree.ordered(), layout.halvings);
  layout.tree = std::move(split.tree);
  layout.regions = std::move(split.regions);
  layout.links = write_links(grid);
  layout.corners = corners_of(grid, *layout.make_record());
  BundleEncoder(grid, layout).encode(stream);
  return stream;
}

}  // namespace lightwell
