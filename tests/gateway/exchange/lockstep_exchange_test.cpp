// Done ticks of other hosts: applied after the records of the role, and of all roles before it, have arrived.
#include "gateway/exchange/lockstep_exchange.hpp"

#include <gtest/gtest.h>

#include <string>

#include "databuffer/runtime/tick_loop.hpp"
#include "tests/gateway/exchange/two_hosts.hpp"

namespace yars::gateway {
namespace {

using databuffer::LockstepRole;

class LockstepExchangeTest : public testing::TwoHosts {
 protected:
  LockstepExchangeTest() {
    auto& lockstep = session_.layout().lockstep;
    lockstep.roles = 1U << index(LockstepRole::flight_model) | 1U << index(LockstepRole::state_machine) |
                     1U << index(LockstepRole::radar_model);
    lockstep.end_tick = -1;
    for (auto& tick : lockstep.done_tick) tick = -1;
    announce("beta", 0);
    announce("gamma", 0);
  }
  static std::uint32_t index(LockstepRole role) { return static_cast<std::uint32_t>(role); }

  void receive(const std::string& host, LockstepRole role, std::int64_t tick, std::uint64_t radar_states = 0) {
    auto sample = from<yars_net_LockstepSample>(host);
    sample.role = index(role);
    sample.done_tick = tick;
    sample.written[dds::index_of(dds::Topic::radar_state)] = radar_states;
    exchange_.receive(context_, sample);
    exchange_.apply(context_, true);
  }
  std::int64_t done(LockstepRole role) const { return layout().lockstep.done_tick[index(role)].load(); }

  LockstepExchange exchange_;
};

TEST_F(LockstepExchangeTest, ADoneTickWaitsForTheRecordsOfItsHost) {
  receive("beta", LockstepRole::flight_model, 0);
  EXPECT_EQ(done(LockstepRole::flight_model), 0);
  receive("gamma", LockstepRole::state_machine, 0, 1);
  EXPECT_EQ(done(LockstepRole::state_machine), -1);
  const auto state = from<yars_net_RadarStateSample>("gamma");
  ASSERT_TRUE(hosts_.is_new(state));
  exchange_.apply(context_, true);
  EXPECT_EQ(done(LockstepRole::state_machine), 0);
}

// The radar model of beta has read what the state machine of gamma did. Its own done tick may overtake gamma's.
TEST_F(LockstepExchangeTest, ADoneTickWaitsForTheRolesBefore) {
  receive("beta", LockstepRole::radar_model, 0);
  EXPECT_EQ(done(LockstepRole::radar_model), -1);
  receive("gamma", LockstepRole::state_machine, 0);
  EXPECT_EQ(done(LockstepRole::state_machine), -1) << "the flight model comes first";
  databuffer::complete_tick(session_.layout().lockstep, index(LockstepRole::flight_model), 0);
  exchange_.apply(context_, true);
  EXPECT_EQ(done(LockstepRole::state_machine), 0);
  EXPECT_EQ(done(LockstepRole::radar_model), 0) << "in the same pass";
}

TEST_F(LockstepExchangeTest, ADoneTickWaitsForTheLastTickOfTheRolesBehind) {
  for (const auto role : {LockstepRole::flight_model, LockstepRole::state_machine}) receive("beta", role, 0);
  receive("beta", LockstepRole::flight_model, 1);
  EXPECT_EQ(done(LockstepRole::flight_model), 0) << "the radar model has not done tick 0";
  receive("gamma", LockstepRole::radar_model, 0);
  EXPECT_EQ(done(LockstepRole::radar_model), 0);
  exchange_.apply(context_, true);
  EXPECT_EQ(done(LockstepRole::flight_model), 1);
}

TEST_F(LockstepExchangeTest, NothingIsAppliedOutOfOrderOrOutOfRange) {
  receive("beta", LockstepRole::flight_model, 3);
  EXPECT_EQ(done(LockstepRole::flight_model), -1) << "the others have not done tick 2";
  const auto before = refusals();
  receive("beta", LockstepRole::flight_model, -1);
  auto sample = from<yars_net_LockstepSample>("beta");
  sample.role = databuffer::kLockstepRoles;
  exchange_.receive(context_, sample);
  EXPECT_EQ(refusals(), before + 2);
}

}  // namespace
}  // namespace yars::gateway
