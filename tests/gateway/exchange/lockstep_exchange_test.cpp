// Done ticks of other hosts: applied after the records of the role, and of all roles before it, have arrived.
#include "gateway/exchange/lockstep_exchange.hpp"

#include <gtest/gtest.h>

#include <string>

#include "runtime/tick_loop.hpp"
#include "tests/gateway/exchange/two_hosts.hpp"

namespace yars::gateway {
namespace {

class LockstepExchangeTest : public testing::TwoHosts {
 protected:
  yars_net_LockstepSample done(const std::string& host, std::uint32_t role, std::int64_t tick) {
    auto sample = from<yars_net_LockstepSample>(host);
    sample.role = role;
    sample.done_tick = tick;
    return sample;
  }
  // A run of flight-model here, and of state-machine and radar-model on other hosts, before its first tick.
  void fly_together() {
    auto& lockstep = session_.layout().lockstep;
    lockstep.roles = 1U << 0 | 1U << 2 | 1U << 3;
    for (auto& tick : lockstep.done_tick) tick = -1;
    announce("beta", 0);
    announce("gamma", 0);
  }
  // Passes of half a second each.
  void wait(double seconds) {
    for (double waited = 0.0; waited < seconds; waited += 0.5) {
      pass(kSecond_ns / 2);
      exchange_.apply(context_, true);
    }
  }
  std::uint32_t lost_role() const { return layout().network.lost_role.load(); }
  std::int64_t tick_of(std::size_t role) const { return layout().lockstep.done_tick[role].load(); }
  LockstepExchange exchange_;
};

TEST_F(LockstepExchangeTest, ADoneTickIsAppliedAfterAllThatItsHostWrote) {
  announce("beta", 0);
  auto sample = done("beta", 3, 20);
  sample.written[dds::index_of(dds::Topic::sweeps)] = 2;
  exchange_.receive(context_, sample);
  exchange_.apply(context_, true);
  EXPECT_LT(tick_of(3), 20);
  const auto take = [&] { return hosts_.is_new(from<yars_net_SweepSample>("beta")); };
  EXPECT_TRUE(take());
  exchange_.apply(context_, true);
  EXPECT_LT(tick_of(3), 20);
  EXPECT_TRUE(take());
  exchange_.apply(context_, false);
  EXPECT_LT(tick_of(3), 20) << "a record still waits for its predecessor";
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(3), 20);
}

TEST_F(LockstepExchangeTest, ADoneTickDoesNotGoBack) {
  announce("beta", 0);
  exchange_.receive(context_, done("beta", 3, 20));
  exchange_.apply(context_, true);
  exchange_.receive(context_, done("beta", 3, 10));
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(3), 20);
  EXPECT_EQ(refusals(), 0u);
}

TEST_F(LockstepExchangeTest, ADoneTickOrRoleOutOfRangeIsRefused) {
  announce("beta", 0);
  exchange_.receive(context_, done("beta", databuffer::kLockstepRoles, 1));
  exchange_.receive(context_, done("beta", 0, -1));
  exchange_.receive(context_, done("beta", 0, databuffer::kLatestModelTick + 1));
  exchange_.apply(context_, true);
  EXPECT_EQ(refusals(), 3u);
}

// Else the run would stand still: nobody sends the tick again.
TEST_F(LockstepExchangeTest, ADoneTickThatArrivesBeforeItsHostIsKnownIsKept) {
  exchange_.receive(context_, done("beta", 3, 20));
  exchange_.apply(context_, true);
  EXPECT_LT(tick_of(3), 20);
  announce("beta", 0);
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(3), 20);
}

// Else a slower host would wait for the end of a run until its roles give up after 60 s.
TEST_F(LockstepExchangeTest, TheLastTickOfAHostThatHasLeftCounts) {
  announce("beta", 0);
  exchange_.receive(context_, done("beta", 3, 20));
  end("beta");
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(3), 20);
}

TEST_F(LockstepExchangeTest, TicksOfManyUnknownHostsLeaveRoom) {
  for (int host = 0; host < 200; ++host)
    for (std::uint32_t role = 0; role < databuffer::kLockstepRoles; ++role)
      exchange_.receive(context_, done("h" + std::to_string(host), role, 5));
  announce("beta", 0);
  exchange_.receive(context_, done("beta", 3, 20));
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(3), 20);
}

TEST_F(LockstepExchangeTest, ATickOfAnotherHostIsNotSentBack) {
  announce("beta", 0);
  exchange_.receive(context_, done("beta", 3, 20));
  exchange_.apply(context_, true);
  const auto sent = [&] { return hosts_.written()[dds::index_of(dds::Topic::lockstep)]; };
  exchange_.begin_pass(context_);
  const std::uint64_t before = sent();
  exchange_.send(context_);
  exchange_.begin_pass(context_);
  exchange_.send(context_);
  const std::uint64_t others = sent() - before;  // roles other than 3, once at the start
  EXPECT_LE(others, databuffer::kLockstepRoles - 1);
  session_.layout().lockstep.done_tick[2].store(21);
  exchange_.begin_pass(context_);
  exchange_.send(context_);
  EXPECT_EQ(sent() - before, others + 1);
}

// The radar model of beta has read what the state machine of gamma did. Its own done tick may overtake gamma's.
TEST_F(LockstepExchangeTest, ADoneTickWaitsForTheRolesBefore) {
  fly_together();
  exchange_.receive(context_, done("beta", 3, 0));
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(3), -1);
  exchange_.receive(context_, done("gamma", 2, 0));
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(2), -1) << "the flight model comes first";
  runtime::complete_tick(session_.layout().lockstep, 0, 0);
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(2), 0);
  EXPECT_EQ(tick_of(3), 0) << "in the same pass";
}

TEST_F(LockstepExchangeTest, ADoneTickWaitsForTheLastTickOfTheRolesBehind) {
  fly_together();
  for (const std::uint32_t role : {0U, 2U}) exchange_.receive(context_, done("beta", role, 0));
  exchange_.apply(context_, true);
  exchange_.receive(context_, done("beta", 0, 1));
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(0), 0) << "the radar model has not done tick 0";
  exchange_.receive(context_, done("gamma", 3, 0));
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(3), 0);
  exchange_.apply(context_, true);
  EXPECT_EQ(tick_of(0), 1);
}

TEST_F(LockstepExchangeTest, ARoleIsLostWhenItsHostHasBeenGoneForTenSeconds) {
  fly_together();
  exchange_.receive(context_, done("beta", 0, 0));
  exchange_.receive(context_, done("gamma", 2, 0));
  exchange_.receive(context_, done("beta", 3, 0));
  wait(20.0);
  EXPECT_EQ(lost_role(), 0u);
  databuffer::NetworkStatus status{};
  hosts_.describe(status, context_.now_ns);
  session_.layout().network_status.publish(status);
  ASSERT_STREQ(status.hosts[2].name, "gamma");
  end("gamma");
  wait(9.5);
  EXPECT_EQ(lost_role(), 0u);
  end("beta");
  wait(20.0);
  EXPECT_EQ(lost_role(), 3u | 2u << 8) << "the state machine of gamma, which went first";
  announce("gamma", 0);
  wait(0.5);
  EXPECT_EQ(lost_role(), 1u | 1u << 8) << "the flight model of beta";
}

TEST_F(LockstepExchangeTest, AHostThatReturnsHasAnotherTenSeconds) {
  fly_together();
  exchange_.receive(context_, done("beta", 0, 0));
  exchange_.apply(context_, true);
  for (int cut = 0; cut < 3; ++cut) {
    end("beta");
    wait(9.0);
    announce("beta", 0);
    wait(0.5);
  }
  EXPECT_EQ(lost_role(), 0u);
}

// Else a host that was stopped would give up the others as soon as it continues.
TEST_F(LockstepExchangeTest, APauseOfTheGatewayIsNoAbsenceOfTheOthers) {
  fly_together();
  exchange_.receive(context_, done("beta", 0, 0));
  exchange_.apply(context_, true);
  end("beta");
  wait(0.5);
  pass(60 * kSecond_ns);
  exchange_.apply(context_, true);
  EXPECT_EQ(lost_role(), 0u);
}

TEST_F(LockstepExchangeTest, ARoleThatHasDoneItsLastTickIsNotLost) {
  fly_together();
  session_.layout().lockstep.end_tick = 1;
  exchange_.receive(context_, done("beta", 0, 0));
  exchange_.apply(context_, true);
  exchange_.receive(context_, done("beta", 0, 1));
  end("beta");
  wait(20.0);
  EXPECT_EQ(tick_of(0), 0) << "the last tick still waits for the other roles";
  EXPECT_EQ(lost_role(), 0u);
  session_.layout().lockstep.end_tick = 2;
  wait(20.0);
  EXPECT_EQ(lost_role(), 1u);
}

TEST_F(LockstepExchangeTest, AnotherEndOfTheRunIsSaidOnceForEachHost) {
  fly_together();
  session_.layout().lockstep.end_tick = 4000;
  const auto receive = [this](const std::string& host, std::uint32_t role, std::uint32_t end) {
    auto sample = done(host, role, 0);
    sample.end = end;
    exchange_.receive(context_, sample);
    exchange_.apply(context_, true);
  };
  receive("gamma", 2, 4001);
  receive("gamma", 3, 0);
  EXPECT_EQ(refusals(), 0u) << "the same end, and none known";
  receive("beta", 0, 6001);
  receive("beta", 3, 6001);
  EXPECT_EQ(refusals(), 1u);
  EXPECT_EQ(last_note(session_),
            "lockstep to tick 6000 on host beta, to tick 4000 here; give both the same --headless");
  receive("gamma", 2, 0xFFFFFFFFU);
  EXPECT_EQ(refusals(), 2u);
}

}  // namespace
}  // namespace yars::gateway
