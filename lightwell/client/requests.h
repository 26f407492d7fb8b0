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
    bool answered = false;   ///< a response has begun that is to be read
    bool arriving = false;   ///< a byte of its body has come
    double heard = 0;        ///< time of the last event
  };
  using Open = std::map<uint32_t, Request>;

  /// What a server that may give less than it is asked for (RFC 9110, 15.3.7) has left to be asked.
  struct Rest {
    Cursor cursor;
    uint64_t end = 0;
    Run run;
  };

  Action ask(std::pair<uint64_t, uint64_t> bytes, std::optional<Run> run, double now);
  Action ask_for_rest(double now);
  Action ask_for_all(double now);
  /// Whether a request that ended has a rest that is worth asking for.
  bool leaves_rest(const Request& request) const;
  /// Notes that an answer was of no use. After a few in a row the whole file is asked for, and after a few of those the
  /// server is given up.
  void distrust();
  void ask_for_nothing_but_all();
  void drop_rests();
  /// Takes an error for one of ranges, as long as the server has not shown that it gives those that it is asked for.
  bool is_fault_of_ranges();
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
  std::vector<Rest> rests_;
  uint32_t useless_ = 0;       ///< answers in a row
  bool ranges_shown_ = false;  ///< a response has said which bytes it has
  bool ever_gained_ = false;
  bool whole_file_only_ = false;
  uint64_t whole_length_ = 0;  ///< of the file as the server has it, by its word or the end of a whole body
  std::optional<uint32_t> whole_file_request_;  ///< the one whose response delivers the whole file
  std::string etag_;                            ///< the first one received
  bool etags_differ_ = false;
  uint64_t length_ = 0;  ///< of the file, as stated by the server; 0 while unknown
  bool stopped_ = false;
  std::optional<FailureUpdate> failure_;
};

}  // namespace lightwell
