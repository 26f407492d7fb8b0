// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/light/lattice_links.h"
#include "lightwell/light/lattice_model.h"
#include "lightwell/light/lattice_order.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/light/stream.h"

namespace lightwell {

/// The codec number of this header's format: nodes in the lattice order, each told by how it differs from the mean of
/// those between which it lies, then bricks in the same way (docs/format.md; docs/decisions/020-lattice.md).
inline constexpr uint8_t light_codec_lattice = 1;
/// The codec number of streams of bricks: the bricks of a region of such a grid (decision 035).
inline constexpr uint8_t bricks_codec_lattice = 0;

/// The parameters of a lattice stream: everything known before the first bundle.
struct LatticeLayout {
  GridShape shape;
  float normal_offset = 0.25f;
  float scale = 1;  ///< E is taken times this power of two: see light_scale
  LightRecord record = LightRecord::moments;
  int steps = 32;    ///< to an octave: see make_lattice_record
  int halvings = 0;  ///< see BrickRegions; of 0 bricks follow the grid's own nodes, else they are apart
  BrickTree tree;    ///< region by region
  std::vector<BrickRegion> regions;
  std::vector<uint8_t> links;  ///< see write_links; those of bricks are told with their nodes. Empty: all are open.
  LatticeNumbers corners;

  static constexpr size_t most_nodes = LightLayout::most_nodes;
  /// Together with what they hold, bricks take 17 kB each where they are decoded.
  static constexpr size_t most_bricks = 20'000;

  /// Whether each region of bricks has a stream of its own.
  bool apart() const { return halvings > 0 && !regions.empty(); }
  std::unique_ptr<const LatticeRecord> make_record() const { return make_lattice_record(record, steps, scale); }

  void write(ByteWriter& writer) const;
  /// Fails on values that no encoder writes and on trailing bytes.
  static Result<LatticeLayout> read(Bytes parameters);

 private:
  void write_head(ByteWriter& writer) const;
};

struct LatticeStream {
  LatticeLayout layout;
  std::vector<LightBundle> bundles;
  /// Those of each region where they are apart; their errors are what is left of the grid's when no other region comes.
  std::vector<std::vector<LightBundle>> regions;
};

/// The parameters of a stream of bricks.
struct BricksLayout {
  uint32_t grid = 0;  ///< the light stream of its grid, which comes before it
  uint32_t region = 0;

  void write(ByteWriter& writer) const;
  /// Fails on trailing bytes.
  static Result<BricksLayout> read(Bytes parameters);
};

struct LatticeStreamOptions {
  LightRecord record = LightRecord::moments;
  int steps = 0;      ///< to an octave of irradiance; 32 adds an error of 0.7 %; 0: see steps_for
  int halvings = -1;  ///< of space, into regions of bricks; negative: see halvings_for
};

/// 32, or 16 where a grid's own noise hides the 1.2 % that these add: noise costs bytes, and finer steps only spell it
/// out.
int steps_for(const LightGrid& grid);

/// Into regions of 16,384 nodes, 60 kB, or less: smaller ones cost more bytes than they spare who sees one of them.
int halvings_for(const LightGrid& grid);

/// Encodes a whole grid. Fails for shapes beyond the limits of LightLayout and LatticeLayout.
Result<LatticeStream> encode_lattice(const LightGrid& grid, const LatticeStreamOptions& options = {});

/// The numbers of a stream as far as they are known: those of the grid's nodes and of the bricks' points, and the links
/// between them. What encoder and decoder do alike.
class LatticeField {
 public:
  explicit LatticeField(const LatticeLayout& layout);

  const LatticeRecord& record() const { return *record_; }
  const std::vector<LatticeNode>& order() const { return order_; }
  const BrickNodes& nodes() const { return nodes_; }
  /// finer_points()
  const std::vector<int>& finer() const { return finer_; }
  /// The number of nodes.
  size_t count() const { return order_.size() + nodes_.nodes().size(); }

  std::span<int32_t> node(uint32_t node) { return values_[node]; }
  std::span<const int32_t> node(uint32_t node) const { return values_[node]; }
  std::span<const int32_t> point(uint32_t brick, int point) const { return points_[place_of(brick, point)]; }
  const Links& links() const { return links_; }

  LatticeExpectation expect(const LatticeNode& node) const { return {*record_, parents(node)}; }
  /// Asks the memory for what expect() will need of a node some places on in the order, which scatters nodes: waiting
  /// for it took a fifth of decoding. (GCC takes a function that only prefetches for one that does nothing, and leaves
  /// out its calls, unless it must inline it.)
  [[gnu::always_inline]] void prefetch(size_t place) const {
    if (place >= order_.size()) return;
    const LatticeNode& node = order_[place];
    for (size_t i = 0; i < node.parent_count; i++) values_.prefetch(node.parents[i]);
  }
  /// Gives the nodes of a grid from `known` on in the order the light between their parents, which are there: by
  /// distance, of those that are valid and in sight. What is expected() is a mean of logarithms, and darker.
  void fill(LightGrid& grid, size_t known) const;
  /// Sets the points of a brick in turn: those that it shares with bricks before it, which must be set, are taken over,
  /// those that hang are as expected, and code(numbers, parents, point) sets the others, of their parents also which
  /// are blocked.
  template <typename Code>
  void set_brick(uint32_t brick, const Code& code);

 private:
  static size_t place_of(uint32_t brick, int point) {
    return size_t(brick) * Brick::points + static_cast<size_t>(point);
  }
  void take_corners(uint32_t brick);
  LatticeParents parents(const LatticeNode& node) const;
  LatticeParents parents(uint32_t brick, int point) const;
  void keep_links(uint32_t brick, int point, const LatticeParents& parents);

  std::unique_ptr<const LatticeRecord> record_;
  BrickTree tree_;
  Vec3i grid_nodes_;
  std::vector<LatticeNode> order_;
  BrickNodes nodes_;
  LatticeNumbers values_;
  LatticeNumbers points_;  // of all bricks
  Links links_;
  std::vector<int> finer_;
};

/// A parent of a brick's point: on the axes on which the point's place is odd, in turn, the neighbours to both sides.
struct BrickParent {
  int point = 0, axis = 0;
  int first = 0;  ///< that of the two points whose link leads to the other
};
const std::vector<BrickParent>& brick_parents(int point);

/// Decodes a lattice stream, and those of its bricks where they are apart. Safe for any bytes.
class LatticeDecoder {
 public:
  /// `stream_bytes` is at least the sum of all payloads. Fails as LatticeLayout::read does, and, before anything of
  /// that size is allocated, when the parameters promise more nodes than that many bytes can hold.
  static Result<LatticeDecoder> open(Bytes parameters, uint64_t stream_bytes);

  const LatticeLayout& layout() const { return layout_; }
  /// Decodes the payload of the next bundle. A failure leaves the state unchanged.
  Result<void> append(Bytes payload);
  /// Whether all that append() is for is here: bricks that are apart are not.
  bool complete() const;
  /// The same for the bricks of a region that is apart, once append() has had all.
  Result<void> append_bricks(size_t region, Bytes payload);
  bool complete(size_t region) const { return regions_[region].bricks == layout_.regions[region].count(); }

  /// Number of nodes known, of total(); a node on the border of two regions counts for both.
  size_t received() const;
  size_t received(size_t region) const;
  size_t total() const { return field_.count(); }
  /// The grid as far as it has come; what is missing lies between what is known, as does the fill of invalid nodes.
  /// With Fill::none missing nodes of the grid's own are dark.
  LightGrid grid(Fill fill) const;

 private:
  /// What has come of a region.
  struct Region {
    uint32_t bricks = 0;
    /// Too large for a WebAssembly stack; none before the first bundle, which goes on where the grid's own nodes ended.
    std::unique_ptr<LatticeCoder> coder;
  };

  explicit LatticeDecoder(LatticeLayout layout);
  Result<void> decode_bricks(size_t region, Bytes payload);
  std::vector<uint32_t> arrived() const;
  void place_bricks(LightGrid& grid) const;

  LatticeLayout layout_;
  LatticeField field_;
  std::unique_ptr<LatticeCoder> coder_;
  size_t base_ = 8;  ///< nodes of the grid's own that have arrived
  std::vector<Region> regions_;
};

/// How many nodes or bricks a bundle holds.
struct LatticeBundle {
  static constexpr size_t wanted = 256;

  /// 256 of the grid's own nodes, or what is left of them.
  static size_t nodes(const LatticeField& field, size_t done);
  /// As many whole bricks of a region, of which so many are done, as it takes to have 256 nodes.
  static uint32_t bricks(const LatticeField& field, const BrickRegion& region, uint32_t done);
};

template <typename Code>
void LatticeField::set_brick(uint32_t brick, const Code& code) {
  take_corners(brick);
  const uint32_t own = nodes_.first()[brick];
  for (const int point : finer_) {
    const std::span<int32_t> numbers = points_[place_of(brick, point)];
    const uint32_t number = nodes_.at(brick, point);
    if (number != BrickNodes::none && number < own) {
      const BrickNode& first = nodes_.nodes()[number];
      std::ranges::copy(points_[place_of(first.brick, first.point)], numbers.begin());
      continue;
    }
    LatticeParents around = parents(brick, point);
    if (number == BrickNodes::none) {
      LatticeExpectation(*record_, around).fill(numbers);
    } else {
      code(numbers, around, point);
      keep_links(brick, point, around);
    }
  }
}

}  // namespace lightwell
