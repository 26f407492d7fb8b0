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
  uint64_t bytes = 0;                                     ///< of the file, received and valid
  uint64_t bytes_total = 0;                               ///< of the file; 0 while unknown
  uint64_t geometry_bytes = 0, geometry_bytes_total = 0;  ///< blocks of meshes and textures
  uint64_t light_bytes = 0, light_bytes_total = 0;
  uint64_t faces = 0, faces_total = 0;
  uint64_t nodes = 0, nodes_total = 0;  ///< of light grids
  uint32_t requests = 0;                ///< sent
  uint32_t failures = 0;                ///< consecutive failed requests; not 0 while the server is unreachable
};

/// Streams a pack: decides what to request, checks and decodes what arrives (docs/format.md), and returns updates for a
/// viewer. It has no clock, threads or I/O: its driver tells it the time (seconds, from any start) and performs its
/// requests.
///
/// The driver repeatedly performs next() until it returns nothing; reports events to respond(), receive(), finish() and
/// fail(); calls work() while it returns true; applies take() until it returns nothing; and comes back at wake() at the
/// latest.
class Client {
 public:
  explicit Client(const ClientOptions& options);
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;
  ~Client();

  /// The next action to perform, if any.
  std::optional<Action> next(double now);
  /// The response to request `id` begins.
  void respond(uint32_t id, const ResponseHead& head, double now);
  /// The next bytes of its body.
  void receive(uint32_t id, Bytes bytes, double now);
  /// Its body ended, completely or not.
  void finish(uint32_t id, double now);
  /// It got no response, or the connection broke.
  void fail(uint32_t id, double now);

  /// Decodes at most one block and fills at most one light grid, which takes a few milliseconds for packs by `lightwell
  /// bake`. False when there was nothing to do.
  bool work();
  /// The next update, of at most about `budget` bytes (a light grid, texture or opening comes whole); nullopt when
  /// there is none.
  std::optional<Update> take(size_t budget);

  /// When to call next() again although nothing was reported: at the end of a pause before a retry, or of the wait for
  /// a silent server; infinity when only a report or take() can change anything. May lie in the past.
  double wake() const;

  /// Sets how much an asset matters to the current picture, initially 1. A run of blocks is valued by the share of its
  /// stream's first error that it removes, times the weight of the asset; 0 puts the asset last. Ignored before the
  /// opening has arrived and for negative, infinite or NaN weights.
  void set_weight(uint32_t asset, float weight);
  /// Both ends of each link between neighbours of a light grid that a wall blocks, as far as it has come, in the grid's
  /// space; for who shows how the grid sees the scene. Nothing of other assets.
  std::vector<Vec3f> blocked_links(uint32_t asset) const;
  /// Changes the strategy from the next request on.
  void set_strategy(Strategy strategy);

  ClientProgress progress() const;
  /// True once take() has returned CompleteUpdate or FailureUpdate.
  bool ended() const;

 private:
  class Machine;
  std::unique_ptr<Machine> machine_;
};

}  // namespace lightwell
