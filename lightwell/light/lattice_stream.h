// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/light/lattice_model.h"
#include "lightwell/light/lattice_order.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/light/stream.h"

namespace lightwell {

/// The codec number of this header's format: nodes in the lattice order, each told by how it differs from the mean of
/// those between which it lies, then bricks in the same way (docs/format.md; docs/decisions/020-lattice.md).
inline constexpr uint8_t light_codec_lattice = 1;

/// The parameters of a lattice stream: everything known before the first bundle.
struct LatticeLayout {
  GridShape shape;
  float normal_offset = 0.25f;
  float scale = 1;  ///< E is taken times this power of two: see light_scale
  int steps = 32;   ///< to an octave: see LatticeSteps
  BrickTree tree;   ///< in the order of BrickTree::ordered
  std::array<LatticeValue, 8> corners{};

  static constexpr size_t most_nodes = LightLayout::most_nodes;
  /// Together with what they hold, bricks take 17 kB each where they are decoded.
  static constexpr size_t most_bricks = 20'000;

  void write(ByteWriter& writer) const;
  /// Fails on values that no encoder writes and on trailing bytes.
  static Result<LatticeLayout> read(Bytes parameters);
};

struct LatticeStream {
  LatticeLayout layout;
  std::vector<LightBundle> bundles;
};

struct LatticeStreamOptions {
  int steps = 32;  ///< to an octave of irradiance; 32 adds an error of 0.7 %
};

/// Encodes a whole grid. Fails for shapes beyond the limits of LightLayout and LatticeLayout.
Result<LatticeStream> encode_lattice(const LightGrid& grid, const LatticeStreamOptions& options = {});

/// The values of a stream as far as they are known: those of the grid's nodes and of the bricks' points. What encoder
/// and decoder do alike.
class LatticeField {
 public:
  explicit LatticeField(const LatticeLayout& layout);

  const std::vector<LatticeNode>& order() const { return order_; }
  const BrickNodes& nodes() const { return nodes_; }
  /// finer_points()
  const std::vector<int>& finer() const { return finer_; }
  /// The number of nodes.
  size_t count() const { return order_.size() + nodes_.nodes().size(); }

  LatticeValue& node(uint32_t node) { return values_[node]; }
  const LatticeValue& node(uint32_t node) const { return values_[node]; }
  const LatticeValue& point(uint32_t brick, int point) const { return bricks_[brick][static_cast<size_t>(point)]; }

  LatticeExpectation expect(const LatticeNode& node) const { return expect(values_, node); }
  /// The values of the grid's nodes when so many are known: those of the others lie between them.
  std::vector<LatticeValue> values(size_t known) const;
  /// Sets the points of a brick in turn: those that it shares with bricks before it, which must be set, are taken over,
  /// those that hang are as expected, and code(value, expectation, point) sets the others.
  template <typename Code>
  void set_brick(uint32_t brick, const Code& code);

 private:
  using Points = std::array<LatticeValue, Brick::points>;
  void take_corners(uint32_t brick);
  static LatticeExpectation expect(const std::vector<LatticeValue>& values, const LatticeNode& node);
  static LatticeExpectation expect(const Points& points, int point);

  BrickTree tree_;
  Vec3i grid_nodes_;
  std::vector<LatticeNode> order_;
  BrickNodes nodes_;
  std::vector<LatticeValue> values_;
  std::vector<Points> bricks_;
  std::vector<int> finer_;
};

/// Decodes a lattice stream. Safe for any bytes.
class LatticeDecoder {
 public:
  /// `stream_bytes` is at least the sum of all payloads. Fails as LatticeLayout::read does, and, before anything of
  /// that size is allocated, when the parameters promise more nodes than that many bytes can hold.
  static Result<LatticeDecoder> open(Bytes parameters, uint64_t stream_bytes);

  const LatticeLayout& layout() const { return layout_; }
  /// Decodes the payload of the next bundle. A failure leaves the state unchanged.
  Result<void> append(Bytes payload);

  /// Number of nodes known, of total().
  size_t received() const { return base_ + nodes_; }
  size_t total() const { return field_.count(); }
  bool complete() const { return received() == total(); }
  /// The grid as far as it has come; what is missing lies between what is known, as does the fill of invalid nodes.
  /// With Fill::none missing nodes of the grid's own are dark.
  LightGrid grid(Fill fill) const;

 private:
  explicit LatticeDecoder(LatticeLayout layout);
  void place_bricks(LightGrid& grid) const;

  LatticeLayout layout_;
  LatticeSteps steps_;
  LatticeField field_;
  std::unique_ptr<LatticeCoder> coder_;  ///< too large for a WebAssembly stack
  size_t base_ = 8;                      ///< nodes of the grid's own that have arrived
  size_t nodes_ = 0;                     ///< nodes of bricks that have arrived
  uint32_t bricks_ = 0;                  ///< bricks that have arrived
};

/// How many nodes or bricks the next bundle holds: 256 of the grid's own nodes or what is left of them, then as many
/// whole bricks as it takes to have as many nodes.
struct LatticeBundle {
  static constexpr size_t wanted = 256;

  size_t base = 0;
  uint32_t bricks = 0;

  static LatticeBundle next(const LatticeField& field, size_t base_done, uint32_t bricks_done);
};

template <typename Code>
void LatticeField::set_brick(uint32_t brick, const Code& code) {
  take_corners(brick);
  Points& points = bricks_[brick];
  const uint32_t own = nodes_.first()[brick];
  for (const int point : finer_) {
    LatticeValue& value = points[static_cast<size_t>(point)];
    const uint32_t number = nodes_.at(brick, point);
    if (number == BrickNodes::none) {
      value = expect(points, point).value();
    } else if (number < own) {
      const BrickNode& first = nodes_.nodes()[number];
      value = bricks_[first.brick][static_cast<size_t>(first.point)];
    } else {
      code(value, expect(points, point), point);
    }
  }
}

}  // namespace lightwell
