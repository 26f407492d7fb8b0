// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/connections.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace lightwell {
namespace {

constexpr double fast = 65536;       // bytes a second
constexpr size_t network_bytes = 8;  // of an IPv6 address

size_t or_any(size_t limit) { return limit == 0 ? std::numeric_limits<size_t>::max() : limit; }

}  // namespace

Peer peer_of(const asio::ip::address& address) {
  if (address.is_v4()) return asio::ip::make_address_v6(asio::ip::v4_mapped, address.to_v4());
  const asio::ip::address_v6 whole = address.to_v6();
  asio::ip::address_v6::bytes_type bytes = whole.to_bytes();
  if (!whole.is_v4_mapped()) std::fill(bytes.begin() + network_bytes, bytes.end(), uint8_t(0));
  return Peer(bytes);
}

void Connections::enter(Connection& connection) {
  of_peer_[connection.peer_]++;
  connection.among_ = &idle_;
  connection.place_ = idle_.insert(idle_.end(), &connection);
}

void Connections::move(Connection& connection, List& list) {
  if (connection.among_ == nullptr) return;
  list.splice(list.end(), *connection.among_, connection.place_);
  connection.among_ = &list;
}

void Connections::leave(Connection& connection) {
  if (connection.among_ == nullptr) return;
  connection.among_->erase(connection.place_);
  connection.among_ = nullptr;
  const auto count = of_peer_.find(connection.peer_);
  if (--count->second == 0) of_peer_.erase(count);
}

bool Connections::make_room() { return idle_.size() + busy_.size() < or_any(limits_.all) || close_one(nullptr); }

bool Connections::make_room_of(const Peer& peer) {
  const auto count = of_peer_.find(peer);
  return count == of_peer_.end() || count->second < or_any(limits_.of_peer) || close_one(&peer);
}

bool Connections::close_an_idle_one() {
  if (idle_.empty()) return false;
  idle_.front()->close();
  return true;
}

/// Closes the one that is missed least, of a peer or of all.
bool Connections::close_one(const Peer* peer) {
  const auto is_meant = [&](const Connection* connection) { return peer == nullptr || connection->peer_ == *peer; };
  const auto idle = std::ranges::find_if(idle_, is_meant);
  if (idle != idle_.end()) {
    (*idle)->close();
    return true;
  }
  const auto now = Connection::Clock::now();
  Connection* slowest = nullptr;
  double least = fast;
  for (Connection* connection : busy_) {
    const double rate = is_meant(connection) ? connection->rate(now).value_or(fast) : fast;
    if (rate >= least) continue;
    least = rate;
    slowest = connection;
  }
  if (slowest != nullptr) slowest->close();
  return slowest != nullptr;
}

void Connections::close_the_late(Connection::Clock::time_point now) {
  std::vector<Connection*> late;
  for (const List* list : {&idle_, &busy_})
    std::ranges::copy_if(*list, std::back_inserter(late), [&](Connection* each) { return each->deadline(now) <= now; });
  for (Connection* connection : late) connection->close();
}

void Connections::finish() {
  for (const List* list : {&idle_, &busy_}) {
    const std::vector<Connection*> connections(list->begin(), list->end());
    for (Connection* connection : connections) connection->finish();
  }
}

}  // namespace lightwell
