// The session clock of two hosts: one owns it, the other follows; requests; epochs.
#include "gateway/exchange/clock_exchange.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "databuffer/session/session_changes.hpp"
#include "tests/gateway/exchange/two_hosts.hpp"

namespace yars::gateway {
namespace {

using databuffer::ClockState;
using databuffer::Role;
using testing::bit;

class ClockExchangeTest : public testing::TwoHosts {
 protected:
  static constexpr std::int64_t kOffset_ns = 700'000'000'000;  // of beta's CLOCK_MONOTONIC

  void pass(std::int64_t elapsed_ns) {
    TwoHosts::pass(elapsed_ns);
    exchange_.exchange(context_);
  }
  void own() {
    pass(0);
    pass(kListening_ns);
    ASSERT_TRUE(exchange_.owns());
  }
  // Beta owns the clock; its offset has been measured.
  void follow(const ClockState& clock) {
    announce("beta", 0, kBetaSegment, 1);
    measure_offset(kOffset_ns);
    receive(clock);
    pass(0);
    ASSERT_FALSE(exchange_.owns());
    ASSERT_TRUE(exchange_.joined());
  }
  void measure_offset(std::int64_t offset_ns) {
    const std::int64_t now_ns = databuffer::monotonic_ns();
    yars_net_ProbeSample answer{};
    answer.from = host_id("alpha");
    answer.to = host_id("beta");
    answer.stage = 1;
    answer.asked_ns = now_ns - 200'000;
    answer.received_ns = answer.answered_ns = now_ns - 100'000 + offset_ns;
    for (int i = 0; i < 6; ++i) hosts_.receive(answer, now_ns);
  }
  void receive(const ClockState& clock) {
    auto sample = from<yars_net_ClockSample>("beta");
    copy_record(sample.clock, clock);
    exchange_.receive(context_, sample);
  }
  static ClockState clock(std::int64_t sim_ns, double rate = 1.0, std::uint32_t epoch = 5) {
    ClockState state{};
    state.base_sim_ns = sim_ns;
    state.base_monotonic_ns = databuffer::monotonic_ns() + kOffset_ns;
    state.rate = rate;
    state.running = 1;
    state.epoch = epoch;
    state.reposition_latitude_deg = std::numeric_limits<double>::quiet_NaN();
    return state;
  }
  // The host has changed the clock `seen`, which it has had until then, into `wanted`. True: the owner's clock changes.
  bool request(const std::string& host, const ClockState& seen, const ClockState& wanted, bool new_epoch) {
    auto sample = from<yars_net_ClockRequestSample>(host);
    sample.owner = host_id("alpha");
    sample.new_epoch = new_epoch ? 1 : 0;
    copy_record(sample.clock, wanted);
    copy_record(sample.before, at(seen, wanted.base_monotonic_ns));
    const ClockState before = session_.clock();
    exchange_.receive(context_, sample);
    const ClockState after = session_.clock();
    return std::memcmp(&before, &after, sizeof before) != 0;
  }
  // The same clock with another base.
  static ClockState at(ClockState clock, std::int64_t monotonic_ns) {
    clock.base_sim_ns = databuffer::sim_time_at(clock, monotonic_ns);
    clock.base_monotonic_ns = monotonic_ns;
    return clock;
  }
  std::uint64_t requests() const { return hosts_.written()[dds::index_of(dds::Topic::clock_requests)]; }
  ClockExchange exchange_;
};

TEST_F(ClockExchangeTest, AHostThatHearsNobodyOwnsTheClockAfterASecond) {
  pass(0);
  pass(kListening_ns / 2);
  EXPECT_FALSE(exchange_.owns());
  pass(kListening_ns / 2);
  EXPECT_TRUE(exchange_.owns());
}

TEST_F(ClockExchangeTest, TheOwnersClockIsAdoptedWithItsOffset) {
  follow(clock(60'000'000'000));
  const ClockState mine = session_.clock();
  EXPECT_EQ(mine.epoch, 5u);
  EXPECT_NEAR(static_cast<double>(session_.sim_time_ns()), 60e9, 1e9) << "the test took less than a second";
  EXPECT_LE(mine.base_monotonic_ns, databuffer::monotonic_ns());
}

TEST_F(ClockExchangeTest, AFrozenClockAndARateAreAdopted) {
  follow(clock(60'000'000'000, 4.0));
  EXPECT_EQ(session_.clock().rate, 4.0);
  ClockState frozen = clock(70'000'000'000);
  frozen.running = 0;
  receive(frozen);
  pass(5'000'000);
  EXPECT_EQ(session_.clock().running, 0u);
  EXPECT_EQ(session_.sim_time_ns(), 70'000'000'000);
}

TEST_F(ClockExchangeTest, AnInvalidClockIsRefused) {
  follow(clock(60'000'000'000));
  const ClockState before = session_.clock();
  ClockState bad = clock(70'000'000'000);
  bad.rate = -1.0;
  receive(bad);
  pass(5'000'000);
  EXPECT_EQ(refusals(), 1u);
  EXPECT_EQ(session_.clock().base_sim_ns, before.base_sim_ns);
}

TEST_F(ClockExchangeTest, ALocalChangeIsRequestedOfTheOwnerOnce) {
  follow(clock(60'000'000'000));
  ASSERT_TRUE(session_.change_clock([](ClockState state) {
    state.running = 0;
    return state;
  }));
  pass(5'000'000);
  pass(5'000'000);
  EXPECT_EQ(requests(), 1u);
  EXPECT_EQ(session_.clock().running, 0u) << "kept until the owner answers";
}

TEST_F(ClockExchangeTest, ALocalChangeThatTheOwnerDoesNotMakeIsTakenBack) {
  follow(clock(60'000'000'000));
  ASSERT_TRUE(session_.change_clock([](ClockState state) {
    state.running = 0;
    return state;
  }));
  pass(5'000'000);
  pass(600'000'000);
  EXPECT_EQ(session_.clock().running, 1u);
  pass(5'000'000);
  EXPECT_EQ(requests(), 1u);
}

TEST_F(ClockExchangeTest, TheOffsetIsSlewedAndSimTimeNeverJumps) {
  follow(clock(60'000'000'000));
  for (int i = 0; i < 16; ++i) measure_offset(kOffset_ns + 1'900'000);
  for (int i = 0; i < 200; ++i) {
    const ClockState before = session_.clock();
    pass(5'000'000);
    const ClockState after = session_.clock();
    const std::int64_t now_ns = databuffer::monotonic_ns();
    EXPECT_LE(std::abs(databuffer::sim_time_at(after, now_ns) - databuffer::sim_time_at(before, now_ns)), 5'000);
  }
  EXPECT_EQ(requests(), 0u) << "the slewed clock is no change of a local program";
}

// The owner begins a new epoch while this host is still behind it.
TEST_F(ClockExchangeTest, AClockThatBeginsAheadOfThisHostIsFollowedExactly) {
  announce("beta", 0, kBetaSegment, 1);
  measure_offset(kOffset_ns - 10'000'000);
  receive(clock(60'000'000'000));
  pass(0);
  for (int i = 0; i < 16; ++i) measure_offset(kOffset_ns);
  const ClockState theirs = clock(70'000'000'000, 1.0, 6);
  receive(theirs);
  for (int i = 0; i < 1000; ++i) pass(5'000'000);
  const std::int64_t now_ns = databuffer::monotonic_ns();
  const std::int64_t error_ns =
      databuffer::sim_time_at(session_.clock(), now_ns) - databuffer::sim_time_at(theirs, now_ns + kOffset_ns);
  EXPECT_LE(std::abs(error_ns), 60'000);
}

// Run with -fsanitize=undefined this finds overflows.
TEST_F(ClockExchangeTest, AnyOffsetAndClockThatPassTheChecksAreFollowedOrRefused) {
  constexpr std::int64_t kLatest = databuffer::kLatestClockBase_ns;
  announce("beta", 0, kBetaSegment, 1);
  for (const std::int64_t offset_ns : {-began_ns_, std::int64_t{0}, kLatest - 2 * began_ns_})
    for (const std::int64_t base_ns : {std::int64_t{0}, kLatest})
      for (const double rate : {0.0, 1.0, 10.0}) {
        for (int i = 0; i < 16; ++i) measure_offset(offset_ns);
        ClockState extreme = clock(kLatest, rate);
        extreme.base_monotonic_ns = base_ns;
        receive(extreme);
        for (int i = 0; i < 3; ++i) pass(5'000'000);
        EXPECT_FALSE(databuffer::validate(session_.clock()));
      }
}

TEST_F(ClockExchangeTest, TheOwnerMakesARequestedChangeOnce) {
  own();
  announce("beta", 0);
  const ClockState wanted = databuffer::with_rate(session_.clock(), 2.0);
  EXPECT_TRUE(request("beta", session_.clock(), wanted, true));
  EXPECT_EQ(session_.clock().rate, 2.0);
  const std::uint32_t epoch = session_.clock().epoch;
  auto again = from<yars_net_ClockRequestSample>("beta");
  again.number = 0;
  again.owner = host_id("alpha");
  again.new_epoch = 1;
  copy_record(again.clock, wanted);
  copy_record(again.before, wanted);
  exchange_.receive(context_, again);
  EXPECT_EQ(session_.clock().epoch, epoch);
}

TEST_F(ClockExchangeTest, RequestsOfUnknownHostsAndInvalidOnesAreNotMade) {
  own();
  const ClockState seen = session_.clock();
  const ClockState wanted = databuffer::with_rate(seen, 2.0);
  EXPECT_FALSE(request("stranger", seen, wanted, false));
  announce("beta", 0);
  EXPECT_FALSE(request("beta", seen, databuffer::with_rate(seen, 200.0), false));
  EXPECT_EQ(refusals(), 1u);
  EXPECT_FALSE(request("beta", databuffer::with_rate(seen, 200.0), wanted, false));
  EXPECT_EQ(refusals(), 2u);
}

// A host asks for a change before the reset has reached it.
TEST_F(ClockExchangeTest, AChangeOfAnEarlierEpochKeepsTheTimeAndThePositionOfTheNewOne) {
  own();
  announce("beta", 0);
  const ClockState seen = session_.clock();
  const databuffer::Repositioning to{{37.0, -122.0}, geo::AltitudeMsl::feet(15000), geo::Bearing::degrees(90)};
  ASSERT_TRUE(session_.change_clock([&](const ClockState& state) {
    ClockState next = databuffer::repositioned(databuffer::reset_to(state, 1000.0), to);
    next.epoch = seen.epoch + 1;
    return next;
  }));
  EXPECT_TRUE(request("beta", seen, databuffer::with_rate(seen, 2.0), false));
  EXPECT_TRUE(request("beta", seen, databuffer::stepped(seen, 10), false));
  const ClockState clock = session_.clock();
  EXPECT_EQ(clock.epoch, seen.epoch + 1);
  EXPECT_EQ(clock.rate, 2.0);
  EXPECT_EQ(clock.running, 0u);
  EXPECT_GE(clock.base_sim_ns, 1'000'000'000'000);
  EXPECT_EQ(clock.reposition_latitude_deg, 37.0);
}

TEST_F(ClockExchangeTest, ChangesOfTwoHostsToOneClockBothTakeEffect) {
  own();
  announce("beta", 0);
  announce("gamma", 0, 77);
  const ClockState seen = session_.clock();
  EXPECT_TRUE(request("beta", seen, databuffer::with_running(seen, false), false));
  const std::int64_t frozen_ns = session_.clock().base_sim_ns;
  EXPECT_TRUE(request("gamma", seen, databuffer::with_rate(seen, 2.0), false));
  EXPECT_EQ(session_.clock().running, 0u);
  EXPECT_EQ(session_.clock().rate, 2.0);
  EXPECT_EQ(session_.clock().base_sim_ns, frozen_ns) << "a frozen clock stands";
}

TEST_F(ClockExchangeTest, StepsOfTwoHostsAddUp) {
  own();
  announce("beta", 0);
  announce("gamma", 0, 77);
  ASSERT_TRUE(session_.change_clock([](const ClockState& state) { return databuffer::stepped(state, 1); }));
  const ClockState seen = session_.clock();
  EXPECT_TRUE(request("beta", seen, databuffer::stepped(seen, 10), false));
  EXPECT_TRUE(request("gamma", seen, databuffer::stepped(seen, 5), false));
  EXPECT_EQ(session_.clock().base_sim_ns, seen.base_sim_ns + 15 * 5'000'000);
}

TEST_F(ClockExchangeTest, AResetKeepsTheFreezeOfAnotherHost) {
  own();
  announce("beta", 0);
  announce("gamma", 0, 77);
  const ClockState seen = session_.clock();
  EXPECT_TRUE(request("beta", seen, databuffer::with_running(seen, false), false));
  EXPECT_TRUE(request("gamma", seen, databuffer::reset_to(seen, 1000.0), true));
  EXPECT_EQ(session_.clock().epoch, seen.epoch + 1);
  EXPECT_EQ(session_.clock().running, 0u);
  EXPECT_EQ(session_.clock().base_sim_ns, 1'000'000'000'000);
}

TEST_F(ClockExchangeTest, ARepositioningKeepsTheTimeOfTheResetOfAnotherHost) {
  own();
  announce("beta", 0);
  announce("gamma", 0, 77);
  const ClockState seen = session_.clock();
  EXPECT_TRUE(request("beta", seen, databuffer::reset_to(seen, 1000.0), true));
  const databuffer::Repositioning to{{37.0, -122.0}, geo::AltitudeMsl::feet(15000), geo::Bearing::degrees(90)};
  EXPECT_TRUE(request("gamma", seen, databuffer::repositioned(seen, to), true));
  EXPECT_EQ(session_.clock().epoch, seen.epoch + 2);
  EXPECT_GE(session_.clock().base_sim_ns, 1'000'000'000'000);
  EXPECT_EQ(session_.clock().reposition_latitude_deg, 37.0);
  EXPECT_TRUE(request("beta", seen, at(seen, databuffer::monotonic_ns()), true));
  EXPECT_EQ(session_.clock().epoch, seen.epoch + 3);
  EXPECT_EQ(session_.clock().reposition_latitude_deg, 37.0) << "beta asks for a new epoch alone";
}

TEST_F(ClockExchangeTest, WhenTwoOwnersMeetTheFirstBeginsALaterEpochThanBoth) {
  own();
  announce("beta", 0, kBetaSegment, 1, 40);
  pass(1'000'000'000);
  EXPECT_TRUE(exchange_.owns()) << "alpha precedes beta";
  EXPECT_EQ(session_.clock().epoch, 41u);
  pass(5'000'000);
  EXPECT_EQ(session_.clock().epoch, 41u) << "once";
}

// Epochs are compared by their difference. A wrong one must not lead back to an early one.
TEST_F(ClockExchangeTest, AnEpochFarFromThisOneIsAnEarlierOne) {
  own();
  const std::uint32_t epoch = session_.clock().epoch;
  announce("beta", 0, kBetaSegment, 1, 0xFFFF'FFFFU);
  pass(5'000'000);
  EXPECT_EQ(session_.clock().epoch, epoch);
}

// A host that was cut off alone and changed nothing disturbs nobody.
TEST_F(ClockExchangeTest, WhenTwoOwnersOfOneEpochMeetItGoesOn) {
  own();
  announce("beta", 0, kBetaSegment, 1, session_.clock().epoch);
  const ClockState before = session_.clock();
  pass(5'000'000);
  EXPECT_TRUE(exchange_.owns());
  EXPECT_EQ(session_.clock().epoch, before.epoch);
  announce("aaron", 0, 77, 1, session_.clock().epoch);
  pass(5'000'000);
  EXPECT_FALSE(exchange_.owns());
  for (int i = 0; i < 3; ++i) pass(600'000'000);
  EXPECT_EQ(requests(), 0u);
}

TEST_F(ClockExchangeTest, TheFlightGoesOnWhereItIsInTheEpochAfterAMeeting) {
  own();
  databuffer::ModelStatus status{};
  status.ownship = testing::good_ownship();
  status.epoch = session_.clock().epoch;
  ASSERT_FALSE(databuffer::validate(status)) << *databuffer::validate(status);
  session_.layout().model_status.publish(status);
  announce("beta", 0, kBetaSegment, 1, 40);
  pass(5'000'000);
  const ClockState clock = session_.clock();
  EXPECT_EQ(clock.epoch, 41u);
  EXPECT_EQ(clock.reposition_latitude_deg, status.ownship.latitude_deg);
  EXPECT_EQ(clock.followed, 1u);
}

// DDS keeps what a host wrote before it was cut off.
TEST_F(ClockExchangeTest, AnOldRequestIsRefused) {
  own();
  announce("beta", 0);
  ClockState wanted = session_.clock();
  wanted.running = 0;
  auto sample = from<yars_net_ClockRequestSample>("beta");
  sample.owner = host_id("alpha");
  copy_record(sample.clock, wanted);
  copy_record(sample.before, wanted);
  sample.clock.base_monotonic_ns = context_.now_ns - 3'000'000'000;
  exchange_.receive(context_, sample);
  EXPECT_EQ(session_.clock().running, 1u);
  EXPECT_EQ(refusals(), 1u);
}

TEST_F(ClockExchangeTest, TheOwnerGivesWayToAHostThatPrecedes) {
  own();
  announce("aaron", 0, 77, 1);
  pass(5'000'000);
  EXPECT_FALSE(exchange_.owns());
}

// The owner may hear of a second holder only when that one has given way.
TEST_F(ClockExchangeTest, AHostThatGivesWayAsksForTheEndOfItsEpochUntilItHasEnded) {
  follow(clock(60'000'000'000));
  const auto role = session_.claim(Role::radar_model);
  ASSERT_TRUE(role);
  pass(5'000'000);
  EXPECT_EQ(requests(), 0u);
  announce("aaron", bit(Role::radar_model), 77);
  pass(5'000'000);
  pass(5'000'000);
  EXPECT_EQ(requests(), 1u);
  pass(600'000'000);
  EXPECT_EQ(requests(), 2u) << "the owner has not answered";
  receive(clock(60'000'000'000, 1.0, 6));
  for (int i = 0; i < 3; ++i) pass(600'000'000);
  EXPECT_EQ(requests(), 2u);
}

TEST_F(ClockExchangeTest, TheOwnerEndsAnEpochThatIsRequestedOnce) {
  own();
  announce("beta", 0);
  ClockState ended = session_.clock();
  ended.epoch = 8;
  auto sample = from<yars_net_ClockRequestSample>("beta");
  sample.owner = host_id("alpha");
  sample.new_epoch = static_cast<std::uint32_t>(EpochRequest::end_of_epoch);
  copy_record(sample.clock, ended);
  copy_record(sample.before, ended);
  sample.clock.base_monotonic_ns = context_.now_ns;
  exchange_.receive(context_, sample);
  EXPECT_EQ(session_.clock().epoch, 9u);
  EXPECT_EQ(session_.clock().rate, ended.rate);
  ++sample.number;
  exchange_.receive(context_, sample);
  EXPECT_EQ(session_.clock().epoch, 9u) << "the epoch has ended already";
}

}  // namespace
}  // namespace yars::gateway
