// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/light/grid.h"
#include "lightwell/light/record.h"
#include "lightwell/light/stream_model.h"

namespace lightwell {

/// The codec number of this header's format: records of moments in the order of slices of S08 (Pacanowski, Granier et
/// al., "Efficient Streaming of 3D Scenes with Complex Geometry and Complex Lighting", Web3D 2008, section 4.1; see
/// light_order).
inline constexpr uint8_t light_codec_slices = 0;

/// Maximum number of nodes per byte of a stream, which bounds a decoder's memory, 200 bytes a node, by the stream's
/// length. Encoders pad shorter payloads; the noisy light of a bake takes several bytes a node.
inline constexpr uint32_t light_nodes_per_byte = 4;

/// The parameters of a light stream (docs/format.md): everything known before the first bundle.
struct LightLayout {
  GridShape shape;
  float normal_offset = 0.5f;
  float scale = 1;                         ///< records hold E times this power of two
  uint64_t seed = 1;                       ///< of the order of the nodes
  int nodes_per_slice = 8;                 ///< number of nodes of each slice in a bundle
  std::array<MomentsRecord, 8> corners{};  ///< records of the corner nodes, x fastest

  static constexpr int most_nodes_an_axis = 256;
  static constexpr size_t most_nodes = size_t(1) << 22;

  void write(ByteWriter& writer) const;
  /// Fails on values that no encoder writes and on trailing bytes.
  static Result<LightLayout> read(Bytes parameters);
};

/// The next nodes of the grid: the payload of one block.
struct LightBundle {
  std::vector<uint8_t> payload;
  uint32_t nodes = 0;
  float error = 0;  ///< estimated RMS error of the nodes still missing after it, relative to the grid's RMS
};

struct LightStream {
  LightLayout layout;
  std::vector<LightBundle> bundles;
};

struct LightStreamOptions {
  int bundle_nodes = 256;  ///< target number of nodes in a bundle, 64 ... 1024
  uint64_t seed = 1;
};

/// Encodes a whole grid: the corners in the layout, then bundles in light_order. Fails for shapes beyond LightLayout's
/// limits and for grids with bricks. Invalid nodes should have been filled (fill_invalid).
Result<LightStream> encode_light(const LightGrid& grid, const LightStreamOptions& options = {});

/// Decodes a light stream. After open and every append, the known nodes of grid() are final and the others dark;
/// push_pull fills them in a copy. Safe for any bytes.
class LightDecoder {
 public:
  /// `stream_bytes` is at least the sum of all payloads. Fails as LightLayout::read does, and, before anything is
  /// allocated, when the parameters promise more nodes than that many bytes can hold.
  static Result<LightDecoder> open(Bytes parameters, uint64_t stream_bytes);

  const LightLayout& layout() const { return layout_; }
  /// Decodes the payload of the next bundle. A failure leaves the state unchanged.
  Result<void> append(Bytes payload);

  /// Number of nodes known, of grid().shape.count().
  size_t received() const { return 8 + at_; }
  bool complete() const { return at_ == order_.nodes.size(); }
  /// One byte per node: 1 where the node is known.
  std::span<const uint8_t> known() const { return records_.known(); }
  /// The known nodes, irradiance in W/m2.
  const LightGrid& grid() const { return grid_; }

 private:
  explicit LightDecoder(const LightLayout& layout);
  void publish(size_t node);

  LightLayout layout_;
  LightOrder order_;
  RecordField records_;
  std::unique_ptr<RecordCoder> coder_;  ///< too large for a WebAssembly stack
  LightGrid grid_;
  size_t at_ = 0;      ///< nodes of order_ that have arrived
  size_t bundle_ = 0;  ///< bundles that have arrived
};

}  // namespace lightwell
