// Ticks, sweeps and latched traffic of the host that has the radar model.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gateway/exchange/history_progress.hpp"
#include "gateway/exchange/model_exchange.hpp"
#include "tests/gateway/exchange/two_hosts.hpp"

namespace yars::gateway {
namespace {

using databuffer::Role;
using testing::bit;
using testing::good_ownship;

class HistoryExchangeTest : public testing::TwoHosts {
 protected:
  void SetUp() override { announce("beta", bit(Role::radar_model)); }
  std::uint32_t epoch() const { return session_.clock().epoch; }
  yars_net_ModelTickSample tick(std::int64_t number, std::uint64_t traffic = 0, const std::string& host = "beta") {
    auto sample = from<yars_net_ModelTickSample>(host);
    databuffer::ModelTick record{};
    record.tick = number;
    record.sim_time_ns = number * radar::kTickNanoseconds;
    record.epoch = epoch();
    record.ownship = good_ownship();
    record.traffic = traffic;
    record.ownship_lane = 1;
    copy_record(sample.tick, record);
    sample.ownship_host = host_id(host);
    return sample;
  }
  // The video is that of video_.
  yars_net_SweepSample sweep(std::int64_t tick, const std::string& host = "beta") {
    auto sample = from<yars_net_SweepSample>(host);
    databuffer::Sweep record{};
    record.tick = tick;
    record.sim_time_ns = tick * radar::kTickNanoseconds;
    record.epoch = epoch();
    record.apex_latitude_deg = 36.6;
    record.apex_longitude_deg = -121.9;
    record.azimuth_left_deg = 10.0;
    record.azimuth_right_deg = 10.5;
    record.range_m = 74'080.0;
    record.scan = 1;
    record.samples = static_cast<std::uint32_t>(video_.size());
    std::copy(video_.begin(), video_.end(), record.video);
    record.hash = databuffer::sweep_hash(record);
    std::memcpy(&sample.sweep, &record, sizeof sample.sweep);
    sample.video._buffer = video_.data();
    sample.video._length = sample.video._maximum = record.samples;
    return sample;
  }
  yars_net_LatchedTrafficSample traffic(std::uint64_t ring_number) {
    auto sample = from<yars_net_LatchedTrafficSample>("beta");
    sample.ring_number = ring_number;
    return sample;
  }
  template <class Sample>
  void receive(const Sample& sample) {
    exchange_.receive(context_, sample);
    exchange_.publish(context_);
  }
  std::uint64_t ticks() const { return layout().model_ticks.next(); }
  std::uint64_t sweeps() const { return layout().sweeps.next(); }
  databuffer::ModelTick last_tick() const {
    databuffer::ModelTick record{};
    std::uint64_t cursor = ticks() - 1;
    EXPECT_TRUE(layout().model_ticks.read(cursor, record).delivered);
    return record;
  }
  std::vector<std::uint8_t> video_ = std::vector<std::uint8_t>(512, 100);
  LaneNames lanes_;
  WorldNumbers worlds_;
  HistoryExchange exchange_{lanes_, worlds_};
};

TEST_F(HistoryExchangeTest, ASweepWaitsForItsTick) {
  receive(sweep(5));
  EXPECT_EQ(sweeps(), 0u);
  receive(tick(5));
  EXPECT_EQ(ticks(), 1u);
  EXPECT_EQ(sweeps(), 1u);
  EXPECT_TRUE(exchange_.is_empty());
  EXPECT_EQ(last_tick().ownship_lane, kNoLane) << "a lane of beta";
}

TEST_F(HistoryExchangeTest, ASweepWhoseTickWasLostComesAfterAWhile) {
  receive(sweep(5));
  pass(300'000'000);
  exchange_.publish(context_);
  EXPECT_EQ(sweeps(), 1u);
}

TEST_F(HistoryExchangeTest, ATickWaitsForTheTrafficThatItNames) {
  receive(tick(5, 8));
  EXPECT_EQ(ticks(), 0u);
  receive(traffic(7));
  EXPECT_EQ(ticks(), 1u);
  EXPECT_EQ(last_tick().traffic, 1u) << "the first record of the ring here";
}

TEST_F(HistoryExchangeTest, ATickWhoseTrafficWasLostNamesTheNewestHere) {
  receive(tick(5, 8));
  pass(300'000'000);
  exchange_.publish(context_);
  ASSERT_EQ(ticks(), 1u);
  EXPECT_EQ(last_tick().traffic, 0u);
}

TEST_F(HistoryExchangeTest, ATickWaitsForTheWorldThatItNames) {
  auto sample = tick(5);
  sample.tick.world = 8;
  receive(sample);
  EXPECT_EQ(ticks(), 0u);
  worlds_.add(host_id("beta"), kBetaSegment, 7, 0);
  exchange_.publish(context_);
  ASSERT_EQ(ticks(), 1u);
  EXPECT_EQ(last_tick().world, 1u) << "the first record of the ring here";
}

// As of a host whose build does not send worlds: only the first tick waits.
TEST_F(HistoryExchangeTest, ATickWhoseWorldWasLostNamesTheNewestHereAndLaterOnesDoNotWait) {
  const auto next = [this](std::int64_t number) {
    auto sample = tick(number);
    sample.tick.world = 8;
    receive(sample);
  };
  next(5);
  pass(300'000'000);
  exchange_.publish(context_);
  ASSERT_EQ(ticks(), 1u);
  EXPECT_EQ(last_tick().world, 0u);
  next(6);
  EXPECT_EQ(ticks(), 2u);
  worlds_.add(host_id("beta"), kBetaSegment, 7, 3);
  next(7);
  EXPECT_EQ(last_tick().world, 4u) << "it has come after all";
}

TEST_F(HistoryExchangeTest, InANewEpochASweepWaitsForATickOfThatEpoch) {
  receive(tick(1000));
  ASSERT_TRUE(session_.change_clock([](auto clock) {
    ++clock.epoch;
    return clock;
  }));
  receive(sweep(3));
  EXPECT_EQ(sweeps(), 0u) << "tick 3 of the new epoch is still to come";
  receive(tick(3));
  EXPECT_EQ(sweeps(), 1u);
}

TEST_F(HistoryExchangeTest, RecordsOfAnEarlierEpochAreLeftOut) {
  const auto old_tick = tick(5);
  const auto old_sweep = sweep(5);
  ASSERT_TRUE(session_.change_clock([](auto clock) {
    ++clock.epoch;
    return clock;
  }));
  receive(old_tick);
  receive(old_sweep);
  pass(kSecond_ns);
  exchange_.publish(context_);
  EXPECT_EQ(ticks(), 0u);
  EXPECT_EQ(sweeps(), 0u);
}

TEST_F(HistoryExchangeTest, RepeatedSamplesAreLeftOutAlsoByANewGateway) {
  const auto first = tick(1);
  const auto second = sweep(1);
  const auto third = traffic(0);
  receive(first);
  receive(second);
  receive(third);
  receive(first);
  receive(second);
  receive(third);
  EXPECT_EQ(ticks(), 1u);
  EXPECT_EQ(sweeps(), 1u);
  EXPECT_EQ(layout().traffic_latched.next(), 1u);
  Hosts hosts(session_, nullptr, {"alpha", 0, 9009, kSegment, 0, 0});
  HistoryExchange next(lanes_, worlds_);
  Context context{session_, nullptr, hosts, roles_};
  context.now_ns = context_.now_ns;
  next.receive(context, first);
  next.receive(context, second);
  next.receive(context, third);
  next.publish(context);
  EXPECT_EQ(ticks(), 1u);
  EXPECT_EQ(sweeps(), 1u);
  EXPECT_EQ(layout().traffic_latched.next(), 1u);
}

// Else the first tick of a lockstep run would be lost on a host whose roles start later.
TEST_F(HistoryExchangeTest, AHistoryBeginsOnceTheAgeOfItsRecordsCanBeJudged) {
  const auto beta = host_id("beta");
  int reads = 0;
  const auto begins = [&](std::optional<std::int64_t> newest) {
    return may_begin(context_, dds::Topic::model_ticks, beta, [&] {
      ++reads;
      return newest;
    });
  };
  databuffer::ClockState clock = session_.clock();
  clock.base_sim_ns = 2 * kSecond_ns;
  clock.base_monotonic_ns = databuffer::monotonic_ns();
  clock.running = 0;
  session_.layout().clock.publish(clock);
  EXPECT_FALSE(begins(std::nullopt));
  EXPECT_FALSE(begins(0)) << "a model that stands still, or a lockstep run";
  EXPECT_TRUE(begins(399));
  EXPECT_EQ(reads, 3);
  context_.lockstep = true;
  EXPECT_TRUE(begins(0));
  EXPECT_TRUE(begins(std::nullopt));
  receive(tick(0));
  context_.lockstep = false;
  EXPECT_EQ(ticks(), 1u);
  EXPECT_FALSE(begins(0)) << "another life of the model's segment";
  EXPECT_EQ(reads, 4) << "the state is read only where its tick decides";
  const auto never = [] { return std::optional<std::int64_t>(); };
  EXPECT_TRUE(may_begin(context_, dds::Topic::model_ticks, hosts_.self().id, never)) << "the model is here";
}

TEST_F(HistoryExchangeTest, TheLastTickOfALockstepRunIsKnown) {
  auto& lockstep = session_.layout().lockstep;
  lockstep.end_tick = 10;
  lockstep.done_tick[0] = 10;
  EXPECT_FALSE(is_last_tick(context_)) << "a live session";
  context_.lockstep = true;
  EXPECT_TRUE(is_last_tick(context_));
  lockstep.done_tick[0] = 9;
  EXPECT_FALSE(is_last_tick(context_));
  lockstep.end_tick = -1;
  EXPECT_FALSE(is_last_tick(context_)) << "a run without an end";
}

TEST_F(HistoryExchangeTest, RecordsOfAHostWithoutTheRoleAreLeftOut) {
  announce("gamma", 0);
  receive(tick(5, 0, "gamma"));
  receive(sweep(5, "gamma"));
  EXPECT_EQ(ticks(), 0u);
  EXPECT_TRUE(exchange_.is_empty());
}

TEST_F(HistoryExchangeTest, InvalidRecordsAreRefused) {
  auto bad_tick = tick(5);
  bad_tick.tick.ownship.latitude_deg = 100.0;
  receive(bad_tick);
  EXPECT_EQ(refusals(), 1u);
  auto bad_sweep = sweep(5);
  bad_sweep.sweep.range_m = -1.0;
  receive(bad_sweep);
  EXPECT_EQ(refusals(), 2u);
  bad_sweep = sweep(5);
  bad_sweep.sweep.hash ^= 1;
  receive(bad_sweep);
  EXPECT_EQ(refusals(), 3u);
  bad_sweep = sweep(5);
  bad_sweep.video._length -= 1;
  receive(bad_sweep);
  EXPECT_EQ(refusals(), 4u);
  auto bad_traffic = traffic(0);
  bad_traffic.traffic.count = 0xFFFF'FFFFU;
  receive(bad_traffic);
  EXPECT_EQ(refusals(), 5u);
  EXPECT_TRUE(exchange_.is_empty());
}

TEST_F(HistoryExchangeTest, ASimTimeThatIsNotThatOfTheTickIsRefused) {
  auto bad_tick = tick(5);
  bad_tick.tick.sim_time_ns += 1;
  receive(bad_tick);
  EXPECT_EQ(refusals(), 1u);
  auto bad_sweep = sweep(5);
  bad_sweep.sweep.sim_time_ns = 0;
  receive(bad_sweep);
  EXPECT_EQ(refusals(), 2u);
  EXPECT_EQ(ticks(), 0u);
  EXPECT_TRUE(exchange_.is_empty());
}

TEST_F(HistoryExchangeTest, TicksThatGoBackInOneEpochAreRefused) {
  receive(tick(1000));
  receive(sweep(1000));
  receive(tick(500));
  receive(sweep(500));
  EXPECT_EQ(refusals(), 2u);
  EXPECT_EQ(ticks(), 1u);
  EXPECT_EQ(sweeps(), 1u);
  receive(tick(1000 - runtime::kMaxTicksBehind));
  EXPECT_EQ(ticks(), 2u) << "a new process of the model";
  ASSERT_TRUE(session_.change_clock([](auto clock) {
    ++clock.epoch;
    return clock;
  }));
  receive(tick(3));
  EXPECT_EQ(ticks(), 3u) << "a new epoch";
  EXPECT_EQ(refusals(), 2u);
}

TEST_F(HistoryExchangeTest, OneTickOfTheFarFutureDoesNotStopTheHistory) {
  receive(tick(databuffer::kLatestModelTick));
  std::int64_t number = 100;
  while (ticks() == 1 && number < 200) receive(tick(number++));
  EXPECT_EQ(number, 120) << "after 20 ticks in a row";
  receive(tick(number));
  EXPECT_EQ(ticks(), 3u);
  receive(tick(101));
  EXPECT_EQ(ticks(), 4u) << "within the ticks that a new process may be behind";
}

TEST_F(HistoryExchangeTest, WhatWaitsIsLimited) {
  for (int i = 0; i < 3000; ++i) exchange_.receive(context_, sweep(5));
  pass(kSecond_ns);
  exchange_.publish(context_);
  EXPECT_EQ(sweeps(), 1024u);
}

}  // namespace
}  // namespace yars::gateway
