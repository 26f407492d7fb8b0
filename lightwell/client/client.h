// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lightwell/asset/update.h"
#include "lightwell/base/bytes.h"
#include "lightwell/client/action.h"
#include "lightwell/client/schedule.h"
#include "lightwell/light/push_pull.h"

namespace lightwell {

struct ClientOptions {
  Strategy strategy = Strategy::interleave;
  Fill fill = Fill::push_pull;  ///< how nodes of the light grid that have not arrived are filled
  uint64_t seed = 1;            ///< of the jitter between retries
};

struct ClientProgress {
  uint64_t bytes = 0;                                     ///< of the file, received and good
  uint64_t bytes_total = 0;                               ///< of the file; 0 while unknown
  uint64_t geometry_bytes = 0, geometry_bytes_total = 0;  ///< blocks of meshes and textures
  uint64_t light_bytes = 0, light_bytes_total = 0;
  uint64_t faces = 0, faces_total = 0;
  uint64_t nodes = 0, nodes_total = 0;  ///< of light grids
  uint32_t requests = 0;                ///< sent
  uint32_t failures = 0;                ///< of requests, in a row: not 0 while the server is away
};

/// Streams a pack: decides what to ask for, checks and decodes what comes, and hands over buffers. It has no clock, no
/// thread and no I/O: whoever drives it tells it the time (seconds, from any start) and carries its requests.
/// docs/format.md says what it reads.
///
/// A driver, in turn: performs next() until it gives nothing; reports to respond(), receive(), finish() or fail() what
/// happens; calls work() while it says so; applies take() while it gives something; and comes back at wake() at the
/// latest.
class Client {
 public:
  explicit Client(const ClientOptions& options);
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;
  ~Client();

  /// The next thing to do, if any.
  std::optional<Action> next(double now);
  /// The response to request `id` begins.
  void respond(uint32_t id, const ResponseHead& head, double now);
  /// The next bytes of its body.
  void receive(uint32_t id, Bytes bytes, double now);
  /// Its body ended, where it should or not.
  void finish(uint32_t id, double now);
  /// It got no response, or the connection broke.
  void fail(uint32_t id, double now);

  /// Decodes at most one block and fills a light grid: a few milliseconds for what `lightwell bake` writes. False when
  /// there was nothing to do.
  bool work();
  /// The next piece to hand over, with at most about `budget` bytes (a light grid, texture or opening comes whole);
  /// nothing when there is none.
  std::optional<Update> take(size_t budget);

  /// When to call next() again although nothing was reported: the end of a pause before a retry, or of the patience
  /// with a silent server; infinity when only a report or take() can bring something new. It may be in the past: time
  /// passes between two calls.
  double wake() const;

  /// How much an asset of any kind matters to the present picture, 1 at first: what a run of its stream's blocks is
  /// worth is the share of the stream's first error that it takes away, times this weight. It is the asset that has a
  /// weight, since that is what a view sees. Finite and not negative, else ignored, as before the opening has been
  /// taken; 0 puts the asset last.
  void set_weight(uint32_t asset, float weight);
  /// Takes another strategy from the next request on.
  void set_strategy(Strategy strategy);

  ClientProgress progress() const;
  /// True when everything has been handed over, or nothing more will be.
  bool ended() const;

 private:
  class Machine;
  std::unique_ptr<Machine> machine_;
};

}  // namespace lightwell
