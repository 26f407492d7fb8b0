// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lightwell/base/random.h"
#include "lightwell/client/client.h"
#include "tests/client/received_scene.h"

namespace lightwell {

/// How bad a network and its server are. Chances are per request.
struct Weather {
  double latency = 0.02;                     ///< seconds
  double jitter = 0;                         ///< seconds, at random: answers overtake each other
  double rate = 1e6;                         ///< bytes a second
  double lost = 0;                           ///< no answer, an error after the latency
  double silent = 0;                         ///< no answer, and no error either
  double truncated = 0;                      ///< the body ends early as if it were whole
  double broken = 0;                         ///< the connection breaks in the middle of the body
  double corrupted = 0;                      ///< one bit of the body is flipped
  double overloaded = 0;                     ///< status 503
  double repeated = 0;                       ///< the whole answer is told twice
  double busy = 0;                           ///< seconds between next() and wake()
  uint64_t longest_range = UINT64_MAX;       ///< an answer to a range has no more bytes
  uint64_t whole_bytes = UINT64_MAX;         ///< an answer with the whole file has no more bytes
  bool wrong_ranges = false;                 ///< an answer to a range says that it is another
  bool nonsense = false;                     ///< an answer to a range has other bytes, and does not say which
  bool undecodable = false;                  ///< an answer to a range breaks before its first byte
  bool ranges = true;                        ///< false: 200 and the whole file, whatever is asked
  bool readable_headers = true;              ///< false: neither Content-Range nor ETag, as from another origin
  double gone_from = 1e9, gone_until = 1e9;  ///< no connection in this time
  uint32_t servers = 1;                      ///< that answer in turn, each with an ETag of its own for the file
  double replaced_at = 1e9;                  ///< another file from then on
  size_t serves_bytes = SIZE_MAX;            ///< the file on the server is cut to this length
  size_t first_body_bytes = SIZE_MAX;        ///< the first body breaks after so many
};

/// Runs a client against a server in bad weather, in simulated time.
class SimulatedNetwork {
 public:
  SimulatedNetwork(const Weather& weather, uint64_t seed, Bytes file, Bytes replacement = {})
      : weather_(weather), random_(seed, 0), file_(file), replacement_(replacement) {}

  /// Until the client ends or `patience` seconds have passed. What a viewer has then; complaint() is not empty when the
  /// client broke a promise on the way.
  ReceivedScene run(const ClientOptions& options, double patience = 3600);
  const std::string& complaint() const { return complaint_; }
  double now() const { return now_; }
  size_t most_in_flight() const { return most_in_flight_; }

 private:
  struct Event {
    enum class Kind : uint8_t { head, bytes, end, failed } kind = Kind::failed;
    uint32_t request = 0;
    int status = 0;
    std::string content_range;
    std::vector<uint8_t> bytes;
    bool replaced = false;
  };

  bool chance(double probability) { return random_.uniform() < probability; }
  void perform(Client& client);
  void ask(const Action& action);
  void send_body(uint32_t request, std::vector<uint8_t> body, double time);
  void deliver(Client& client, const Event& event);
  void drain(Client& client, ReceivedScene& scene);

  Weather weather_;
  Random random_;
  Bytes file_, replacement_;
  double now_ = 0;
  double line_free_ = 0;
  std::multimap<double, Event> events_;
  std::set<uint32_t> in_flight_;
  size_t most_in_flight_ = 0;
  std::string complaint_;
};

}  // namespace lightwell
