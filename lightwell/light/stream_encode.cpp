// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/base/model_coder.h"
#include "lightwell/light/stream.h"
#include "lightwell/light/stream_head.h"

namespace lightwell {
namespace {

// Sums over the valid nodes of a bundle of the squares of E, and of the errors of its expectation, E in units of 2^-24.
struct Squares {
  double value = 0;
  double error = 0;

  void add(const MomentsRecord& record, const RecordExpectation& expected) {
    for (size_t d = 0; d < 6; d++) {
      const SharedExponent actual = SharedExponent::of(record.irradiance[d]);
      for (size_t c = 0; c < 3; c++) {
        const auto truth = static_cast<double>(int64_t(actual.mantissa[c]) << actual.exponent);
        const double difference = truth - static_cast<double>(expected.irradiance[d][c]);
        value += truth * truth;
        error += difference * difference;
      }
    }
  }
};

// Estimates the error that remains after each bundle. The next bundle is a random sample of the missing nodes, so the
// prediction errors of its nodes stand for those of all. Errors never increase.
void estimate_errors(std::vector<LightBundle>& bundles, const std::vector<Squares>& squares) {
  double value = 0, missing = 0;
  for (const Squares& s : squares) value += s.value;
  for (const LightBundle& b : bundles) missing += b.nodes;
  float bound = 1;
  for (size_t k = 0; k + 1 < bundles.size(); k++) {
    missing -= bundles[k].nodes;
    const double error = squares[k + 1].error * missing / bundles[k + 1].nodes;
    if (value > 0) bound = std::min(bound, static_cast<float>(std::sqrt(error / value)));
    bundles[k].error = bound;
  }
}

MomentsRecord record_of(const LightGrid& grid, float scale, size_t node) {
  return encode_record(grid.moments[node] * scale, grid.valid[node]);
}

LightLayout layout_of(const LightGrid& grid, const LightStreamOptions& options) {
  LightLayout layout;
  layout.shape = grid.shape;
  layout.normal_offset = grid.normal_offset;
  layout.scale = light_scale(grid);
  layout.seed = options.seed;
  const int slices = *std::max_element(grid.shape.nodes.e.begin(), grid.shape.nodes.e.end());
  layout.nodes_per_slice = std::max(1, options.bundle_nodes / slices);
  const std::array<size_t, 8> corners = corner_nodes(grid.shape);
  for (size_t i = 0; i < corners.size(); i++) layout.corners[i] = record_of(grid, layout.scale, corners[i]);
  return layout;
}

// Encodes the bundles in order; each node is predicted from those before it.
class BundleEncoder {
 public:
  BundleEncoder(const LightGrid& grid, const LightLayout& layout)
      : grid_(grid), scale_(layout.scale), field_(grid.shape) {
    const std::array<size_t, 8> corners = corner_nodes(grid.shape);
    for (size_t i = 0; i < corners.size(); i++) field_.set(corners[i], layout.corners[i]);
  }

  LightBundle encode(std::span<const uint32_t> nodes, Squares& squares) {
    ModelWriter writer;
    for (const uint32_t node : nodes) {
      MomentsRecord record = record_of(grid_, scale_, node);
      if (record.valid()) squares.add(record, field_.expect(field_.neighbours(node), true));
      coder_.code(writer, record, field_, node);
      field_.set(node, record);
    }
    LightBundle bundle{.payload = writer.finish(), .nodes = static_cast<uint32_t>(nodes.size())};
    const size_t least = (nodes.size() + light_nodes_per_byte - 1) / light_nodes_per_byte;
    bundle.payload.resize(std::max(bundle.payload.size(), least));
    return bundle;
  }

 private:
  const LightGrid& grid_;
  float scale_;
  RecordField field_;
  RecordCoder coder_;
};

Result<void> check_shape(const LightGrid& grid) {
  if (!grid.tree.empty()) return fail(ErrorKind::unsupported, "light grid", "the order of slices knows no bricks");
  for (const int n : grid.shape.nodes.e) {
    if (n < 2 || n > LightLayout::most_nodes_an_axis)
      return fail("light grid", "an axis has " + std::to_string(n) + " nodes, not 2 to " +
                                    std::to_string(LightLayout::most_nodes_an_axis));
  }
  if (grid.shape.count() > LightLayout::most_nodes)
    return fail(ErrorKind::limit, "light grid", "more than " + std::to_string(LightLayout::most_nodes) + " nodes");
  LW_ASSERT(grid.moments.size() == grid.shape.count() && grid.valid.size() == grid.shape.count());
  return {};
}

}  // namespace

void LightLayout::write(ByteWriter& writer) const {
  write_shape(writer, shape);
  writer.u16(static_cast<uint16_t>(nodes_per_slice));
  writer.f32(normal_offset);
  writer.f32(scale);
  writer.u64(seed);
  for (const MomentsRecord& corner : corners) corner.write(writer);
}

Result<LightStream> encode_light(const LightGrid& grid, const LightStreamOptions& options) {
  LW_CHECK(check_shape(grid));
  LW_ASSERT(options.bundle_nodes >= 64 && options.bundle_nodes <= 1024);
  LightStream stream;
  stream.layout = layout_of(grid, options);
  const LightOrder order = light_order(grid.shape, stream.layout.seed, stream.layout.nodes_per_slice);
  BundleEncoder encoder(grid, stream.layout);
  std::vector<Squares> squares;
  uint32_t at = 0;
  for (const uint32_t end : order.ends) {
    const std::span<const uint32_t> nodes(order.nodes.data() + at, end - at);
    stream.bundles.push_back(encoder.encode(nodes, squares.emplace_back()));
    at = end;
  }
  estimate_errors(stream.bundles, squares);
  return stream;
}

}  // namespace lightwell
