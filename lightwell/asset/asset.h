// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "lightwell/asset/update.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// The number of the asset that a stream refines. An asset is what updates and weights name: a mesh, a light grid or an
/// image. Every stream of format 0 refines one asset, and what the JSON extensions call `stream` is the number of both;
/// a codec that puts many assets into a stream numbers them here, and nowhere else.
constexpr uint32_t asset_of_stream(uint32_t stream) { return stream; }

/// The decoder of one stream, whatever its kind and codec: takes the stream's blocks and hands over updates of the
/// asset that they refine. Its memory is bounded by what has arrived and by the budget that it was opened with
/// (asset/codecs.h); any bytes give updates or an error.
class AssetDecoder {
 public:
  virtual ~AssetDecoder() = default;

  /// False while a hand-over is under way that a further block would disturb.
  virtual bool accepts() const { return true; }
  /// Decodes the stream's next block.
  virtual Result<void> append(Bytes payload) = 0;
  /// Vertices, nodes or bytes so far, as the rows of the block table count them in `adds`.
  virtual uint64_t added() const = 0;
  /// True when the stream has brought all that its parameters promise.
  virtual bool complete() const = 0;

  /// Does what is left to do before the blocks so far can be handed over, if it is time for it. True when there was
  /// something.
  virtual bool settle() { return false; }
  /// False when settle() has something to do.
  virtual bool settled() const { return true; }
  /// What has to be known of the asset before a piece of any is handed over; asked for once.
  virtual std::optional<Update> announce() { return std::nullopt; }
  /// The next piece to hand over, of at most about `budget` bytes; none when all is handed over.
  virtual std::optional<Update> take(size_t budget) = 0;

  /// Faces or nodes that have been decoded, and that there will be; 0 for other kinds.
  virtual uint64_t decoded() const { return 0; }
  virtual uint64_t total() const { return 0; }
};

}  // namespace lightwell
