// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <list>
#include <map>
#include <optional>

#include "lightwell/base/beast.h"

namespace lightwell {

/// Whose connections count together: those of an IPv4 address, or of the first 64 bits of an IPv6 address, which are
/// what one customer of a provider has.
using Peer = asio::ip::address_v6;
Peer peer_of(const asio::ip::address& address);

/// A connection as those see it who decide whether it goes on.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Connection(Peer peer) : peer_(std::move(peer)) {}
  virtual ~Connection() = default;

  const Peer& peer() const { return peer_; }
  /// When its time is up, as far as is known at `now`.
  virtual Clock::time_point deadline(Clock::time_point now) = 0;
  /// Bytes a second that it takes; nothing while it is too young to be judged.
  virtual std::optional<double> rate(Clock::time_point now) const = 0;
  /// Closes the connection if no answer is under way, else after it.
  virtual void finish() = 0;
  /// Closes the connection, which leaves those that are open.
  virtual void close() = 0;

 private:
  friend class Connections;
  std::list<Connection*>* among_ = nullptr;
  std::list<Connection*>::iterator place_;
  Peer peer_;
};

/// The open connections of a server: the idle ones, which wait for a request, and the busy ones. Where there are too
/// many, those go that cost the least: who has been idle longest, then who takes its answer the slowest. Who takes 64
/// KB a second or more stays.
class Connections {
 public:
  /// How many may be open, in all and of one peer; 0 is any number.
  struct Limits {
    size_t all = 0, of_peer = 0;
  };
  explicit Connections(Limits limits) : limits_(limits) {}

  /// Adds a connection, as an idle one.
  void enter(Connection& connection);
  void becomes_idle(Connection& connection) { move(connection, idle_); }
  void becomes_busy(Connection& connection) { move(connection, busy_); }
  /// Removes a connection, if it has not been removed.
  void leave(Connection& connection);

  bool empty() const { return idle_.empty() && busy_.empty(); }
  /// Makes sure that another one may enter. False when that has to wait until one leaves.
  bool make_room();
  /// The same for one of this peer.
  bool make_room_of(const Peer& peer);
  /// Closes the one that has been idle longest; false when none is.
  bool close_an_idle_one();
  /// Closes those whose time is up.
  void close_the_late(Connection::Clock::time_point now);
  /// Finishes all.
  void finish();

 private:
  using List = std::list<Connection*>;
  void move(Connection& connection, List& list);
  bool close_one(const Peer* peer);

  Limits limits_;
  List idle_, busy_;  ///< in the order in which they became so
  std::map<Peer, size_t> of_peer_;
};

}  // namespace lightwell
