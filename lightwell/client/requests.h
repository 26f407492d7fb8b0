// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightwell/asset/update.h"
#include "lightwell/client/action.h"
#include "lightwell/client/download.h"
#include "lightwell/client/line_estimate.h"
#include "lightwell/client/run_order.h"
#include "lightwell/client/schedule.h"

namespace lightwell {

/// The requests of a client: requests what a download lacks, follows the responses, and retries what failed.
class Requests {
 public:
  Requests(Download& download, Strategy strategy, uint64_t seed)
      : download_(download), order_(download), strategy_(strategy), line_(seed) {}

  /// The next action, if any; `weights` as in choose().
  std::optional<Action> next(std::span<const float> weights, double now);
  void respond(uint32_t id, const ResponseHead& head, double now);
  void receive(uint32_t id, Bytes bytes, double now);
  void finish(uint32_t id, double now);
  void fail(uint32_t id, double now);

  void set_strategy(Strategy strategy) { strategy_ = strategy; }
  /// Cancels all open requests and makes no more.
  void stop();
  /// Why the requests gave up; nullopt while they run, and after stop() was called from outside.
  const std::optional<FailureUpdate>& failure() const { return failure_; }

  /// True while the response that delivered the opening is still arriving and will deliver the file up to `position`.
  bool opening_brings(uint64_t position) const;

  double wake() const;
  uint32_t sent() const { return next_id_ - 1; }
  uint32_t failures() const { return line_.failures(); }

 private:
  struct Request {
    Cursor cursor;
    uint64_t end = 0;        ///< the body is read up to this position of the file
    std::optional<Run> run;  ///< the requested extents; nullopt for the opening and the witness
    uint64_t gained = 0;     ///< valid bytes received
    double heard = 0;        ///< time of the last event
  };
  using Open = std::map<uint32_t, Request>;

  Action ask(std::pair<uint64_t, uint64_t> bytes, std::optional<Run> run, double now);
  std::optional<Action> ask_for_extents(std::span<const float> weights, double now);
  void respond_partial(Open::iterator request, std::string_view content_range, double now);
  void respond_whole(Open::iterator request);
  void respond_refused(Open::iterator request, const ResponseHead& head, double now);
  /// Gives up when this length differs from that of earlier responses or of the GLB header.
  void check_length(uint64_t length);
  void note_etag(std::string_view etag);
  /// Removes a request that has ended. A failed one starts a pause.
  void end(Open::iterator request, bool failed, double now);
  /// Cancels a request that failed.
  void abandon(Open::iterator request, double now);
  void drop_silent(double now);
  void give_up(FailureUpdate failure);
  void give_up(FailureUpdate::Reason reason, std::string message);

  Download& download_;
  RunOrder order_;
  Strategy strategy_;
  LineEstimate line_;
  uint32_t next_id_ = 1;
  double looked_ = -1;  ///< time of the last next()
  Open open_;
  std::vector<uint32_t> cancels_;
  std::optional<uint32_t> whole_file_request_;  ///< the one whose response delivers the whole file
  std::string etag_;                            ///< the first one received
  bool etags_differ_ = false;
  uint64_t length_ = 0;  ///< of the file, as stated by the server; 0 while unknown
  bool stopped_ = false;
  std::optional<FailureUpdate> failure_;
};

}  // namespace lightwell
