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

/// The codec number of this header's format: records of moments, sent in the order of slices of Pacanowski et al.,
/// "Efficient Streaming of 3D Scenes with Complex Geometry and Complex Lighting", Web3D 2008 (S08), its streaming of
/// lighting.
inline constexpr uint8_t light_codec_slices = 0;

/// The most nodes that a byte of a stream may stand for. It bounds a decoder's memory, 200 bytes a node, by the
/// stream's length. Encoders pad a payload that is shorter; estimated light takes several bytes a node.
inline constexpr uint32_t light_nodes_per_byte = 4;

/// The parameters of a light stream (docs/format.md): all that is known before the first bundle.
struct LightLayout {
  GridShape shape;
  float normal_offset = 0.5f;
  float scale = 1;                         ///< records hold E times this power of two
  uint64_t seed = 1;                       ///< of the random places
  int nodes_per_slice = 8;                 ///< how many nodes of every slice a bundle brings
  std::array<MomentsRecord, 8> corners{};  ///< nodes of the grid's corners, x fastest

  static constexpr int most_nodes_an_axis = 256;
  static constexpr size_t most_nodes = size_t(1) << 22;

  void write(ByteWriter& writer) const;
  /// Fails on numbers that no encoder writes, and on trailing bytes.
  static Result<LightLayout> read(Bytes parameters);
};

/// A few more nodes of the grid: the payload of one block.
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
  int bundle_nodes = 256;  ///< wanted size of a bundle, 64 ... 1024
  uint64_t seed = 1;
};

/// Encodes a whole grid: the corners in the layout, then bundles with an equal number of nodes of every slice across
/// the longest axis, at random places (S08, streaming of lighting). Shapes beyond LightLayout's limits are an error.
/// Invalid nodes should have been filled.
Result<LightStream> encode_light(const LightGrid& grid, const LightStreamOptions& options = {});

/// The decoder of a light stream. After open and after every append the known nodes of grid() are final and the others
/// are dark; push_pull fills them in a copy. Any bytes give a state or an error.
class LightDecoder {
 public:
  /// `stream_bytes` is the sum of all blocks' payloads, or more: parameters that promise more nodes than so many bytes
  /// can hold are refused before anything is allocated. Errors: that, and LightLayout::read.
  static Result<LightDecoder> open(Bytes parameters, uint64_t stream_bytes);

  const LightLayout& layout() const { return layout_; }
  /// Decodes the payload of the next bundle. After an error the state is what it was before.
  Result<void> append(Bytes payload);

  /// Number of nodes known, of grid().shape.count().
  size_t received() const { return 8 + at_; }
  bool complete() const { return at_ == order_.nodes.size(); }
  /// A byte a node: 1 where grid() holds the node.
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
