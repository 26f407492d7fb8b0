// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/connections.h"

#include <gtest/gtest.h>

#include <memory>

#include "lightwell/server/request_rate.h"

namespace lightwell {
namespace {

using namespace std::chrono_literals;

Peer peer_at(const std::string& address) { return peer_of(asio::ip::make_address(address)); }

/// A connection that does nothing by itself.
class Dummy final : public Connection {
 public:
  Dummy(Connections& connections, const std::string& address)
      : Connection(peer_at(address)), connections_(connections) {
    connections_.enter(*this);
  }
  ~Dummy() override { connections_.leave(*this); }

  Clock::time_point deadline(Clock::time_point) override { return deadline_; }
  std::optional<double> rate(Clock::time_point) const override { return rate_; }
  void finish() override { finished_ = true; }
  void close() override {
    open_ = false;
    connections_.leave(*this);
  }
  void works_at(std::optional<double> rate) {
    rate_ = rate;
    connections_.becomes_busy(*this);
  }

  Connections& connections_;
  Clock::time_point deadline_ = Clock::time_point::max();
  std::optional<double> rate_;
  bool open_ = true, finished_ = false;
};

TEST(Peer, IsAnAddressOrAnIPv6Network) {
  EXPECT_EQ(peer_at("10.1.2.3"), peer_at("::ffff:10.1.2.3"));
  EXPECT_NE(peer_at("10.1.2.3"), peer_at("10.1.2.4"));
  EXPECT_EQ(peer_at("2001:db8:1:2:3:4:5:6"), peer_at("2001:db8:1:2::7"));
  EXPECT_NE(peer_at("2001:db8:1:2::7"), peer_at("2001:db8:1:3::7"));
}

TEST(Connections, TheLongestIdleGoesFirst) {
  Connections connections({3, 0});
  Dummy busy(connections, "10.0.0.1"), first(connections, "10.0.0.2"), second(connections, "10.0.0.3");
  busy.works_at(1);
  connections.becomes_busy(first);
  connections.becomes_idle(first);  // and is idle since later than the second
  EXPECT_TRUE(connections.make_room());
  EXPECT_TRUE(busy.open_ && first.open_ && !second.open_);
  EXPECT_TRUE(connections.make_room()) << "there is room";
  EXPECT_TRUE(first.open_);
}

TEST(Connections, ThenTheSlowest) {
  Connections connections({4, 0});
  Dummy slow(connections, "10.0.0.1"), slowest(connections, "10.0.0.2"), fast(connections, "10.0.0.3"),
      fresh(connections, "10.0.0.4");
  slow.works_at(20000);
  slowest.works_at(100);
  fast.works_at(1e6);
  fresh.works_at(std::nullopt);
  EXPECT_TRUE(connections.make_room());
  EXPECT_FALSE(slowest.open_);
  Dummy next(connections, "10.0.0.5");
  next.works_at(std::nullopt);
  EXPECT_TRUE(connections.make_room());
  EXPECT_FALSE(slow.open_);
  Dummy last(connections, "10.0.0.6");
  last.works_at(2e6);
  EXPECT_FALSE(connections.make_room()) << "nobody is idle or slow";
  EXPECT_TRUE(fast.open_ && fresh.open_ && next.open_ && last.open_);
}

TEST(Connections, OnePeerPushesOutItsOwn) {
  Connections connections({0, 2});
  Dummy other(connections, "10.0.0.9"), first(connections, "2001:db8::1"), second(connections, "2001:db8::2");
  EXPECT_TRUE(connections.make_room());
  EXPECT_TRUE(connections.make_room_of(peer_at("10.0.0.9")));
  EXPECT_TRUE(first.open_);
  EXPECT_TRUE(connections.make_room_of(peer_at("2001:db8::3")));
  EXPECT_TRUE(other.open_ && !first.open_ && second.open_);
  Dummy third(connections, "2001:db8::3");
  second.works_at(1e6);
  third.works_at(1e6);
  EXPECT_FALSE(connections.make_room_of(peer_at("2001:db8::4")));
}

TEST(Connections, TheLateAreClosed) {
  Connections connections({0, 0});
  Dummy late(connections, "10.0.0.1"), later(connections, "10.0.0.1"), busy(connections, "10.0.0.1");
  const auto now = Connection::Clock::now();
  late.deadline_ = now;
  later.deadline_ = now + 1s;
  busy.works_at(1);
  busy.deadline_ = now - 1s;
  connections.close_the_late(now);
  EXPECT_TRUE(!late.open_ && later.open_ && !busy.open_);
}

TEST(Connections, AllFinish) {
  Connections connections({0, 0});
  EXPECT_TRUE(connections.empty());
  Dummy idle(connections, "10.0.0.1"), busy(connections, "10.0.0.1");
  busy.works_at(1);
  connections.finish();
  EXPECT_TRUE(idle.finished_ && busy.finished_);
  EXPECT_FALSE(connections.empty());
}

TEST(RequestRate, HoldsEachPeerToItsNumber) {
  RequestRate rate(10);
  const RequestRate::Clock::time_point begin{};
  int allowed = 0;
  for (int i = 0; i < 1000; i++) allowed += rate.allows(peer_at("10.0.0.1"), begin + i * 10ms) ? 1 : 0;  // for 10 s
  EXPECT_GE(allowed, 100);
  EXPECT_LE(allowed, 100 + 10) << "those of one second are saved up at the beginning";
  EXPECT_TRUE(rate.allows(peer_at("10.0.0.2"), begin + 10s));
  EXPECT_EQ(rate.remembered(), 2u);
  rate.forget(begin + 12s);
  EXPECT_EQ(rate.remembered(), 0u);
}

TEST(RequestRate, MayBeLessThanOneASecondOrAnyNumber) {
  RequestRate rare(0.1), any(0);
  const RequestRate::Clock::time_point begin{};
  EXPECT_TRUE(rare.allows(peer_at("10.0.0.1"), begin));
  EXPECT_FALSE(rare.allows(peer_at("10.0.0.1"), begin + 9s));
  EXPECT_TRUE(rare.allows(peer_at("10.0.0.1"), begin + 10s));
  for (int i = 0; i < 1000; i++) EXPECT_TRUE(any.allows(peer_at("10.0.0.1"), begin));
  EXPECT_EQ(any.remembered(), 0u);
}

}  // namespace
}  // namespace lightwell
