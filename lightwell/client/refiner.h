// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/client/update.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/pack/directory.h"

namespace lightwell {

/// Turns the blocks of one stream into updates.
class Refiner {
 public:
  virtual ~Refiner() = default;

  /// False while a hand-over is under way that a further block would disturb.
  virtual bool accepts() const { return true; }
  /// Decodes the stream's next block.
  virtual Result<void> append(Bytes payload) = 0;
  /// Does what is left to do before the blocks so far can be handed over, if it is time for it. True when there was
  /// something.
  virtual bool settle() { return false; }
  /// False when settle() has something to do.
  virtual bool settled() const { return true; }
  /// What has to be known of the stream before a piece of any is handed over; asked for once.
  virtual std::optional<Update> announce() { return std::nullopt; }
  /// The next piece to hand over, of at most about `budget` bytes; none when all is handed over.
  virtual std::optional<Update> take(size_t budget) = 0;

  /// True when the stream has brought all that its parameters promise.
  virtual bool complete() const = 0;
  /// Faces or nodes that have been decoded, and that there will be; 0 for other kinds.
  virtual uint64_t decoded() const { return 0; }
  virtual uint64_t total() const { return 0; }
};

/// Reads a stream's parameters and makes its refiner. `bin` is the data of the opening's BIN chunk; `budget` is how
/// many bytes of buffers the streams may still ask for together, and becomes less. Fails for a codec that this program
/// does not know, for sizes that the stream's length cannot hold, and for those beyond the budget; nothing of such a
/// size is allocated.
Result<std::unique_ptr<Refiner>> make_refiner(const Directory& directory, uint32_t stream, Bytes bin, Fill fill,
                                              uint64_t& budget);

Result<std::unique_ptr<Refiner>> make_mesh_refiner(const StreamEntry& entry, uint32_t stream, Bytes bin,
                                                   uint64_t& budget);
Result<std::unique_ptr<Refiner>> make_light_refiner(const StreamEntry& entry, uint32_t stream, Fill fill,
                                                    uint64_t& budget);
Result<std::unique_ptr<Refiner>> make_texture_refiner(const StreamEntry& entry, uint32_t stream, uint64_t& budget);

/// Takes bytes from a budget; fails when there are fewer.
Result<void> spend(uint64_t& budget, uint64_t bytes);

}  // namespace lightwell
