// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "lightwell/asset/update.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// The number of the asset that a stream refines. An asset is what updates and weights refer to: a mesh, a light grid
/// or an image. In format 0 every stream refines one asset of the same number, which the JSON extensions call `stream`;
/// a codec with many assets in a stream would number them here, and only here.
constexpr uint32_t asset_of_stream(uint32_t stream) { return stream; }

/// Decodes one stream of any kind and codec: takes its blocks and returns updates of the asset that they refine. Memory
/// is bounded by what has arrived and by the budget of the AssetContext (asset/codecs.h). Safe for any bytes.
class AssetDecoder {
 public:
  virtual ~AssetDecoder() = default;

  /// False while updates are being taken that a further block would disturb.
  virtual bool accepts() const { return true; }
  /// Decodes the stream's next block.
  virtual Result<void> append(Bytes payload) = 0;
  /// Vertices, nodes or bytes decoded so far, in the unit of BlockRow::adds.
  virtual uint64_t added() const = 0;
  /// True when everything that the parameters promise has been decoded.
  virtual bool complete() const = 0;

  /// Prepares the blocks so far for take(), if it is time to. Returns false when there was nothing to do.
  virtual bool settle() { return false; }
  /// False when settle() has something to do.
  virtual bool settled() const { return true; }
  /// The update that must precede all others of the asset, if any; called once.
  virtual std::optional<Update> announce() { return std::nullopt; }
  /// The next update, of at most about `budget` bytes; nullopt when there is none.
  virtual std::optional<Update> take(size_t budget) = 0;

  /// Faces or nodes decoded so far, and in the final state; 0 for other kinds.
  virtual uint64_t decoded() const { return 0; }
  virtual uint64_t total() const { return 0; }
};

}  // namespace lightwell
