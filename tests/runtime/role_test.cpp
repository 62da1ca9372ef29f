// Start of a program that holds a role, at once and as a standby.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "runtime/claims.hpp"
#include "tests/databuffer/session/open_session.hpp"

namespace yars::runtime {
namespace {

class RoleTest : public databuffer::testing::OpenSessionTest {
 protected:
  static constexpr auto kRole = databuffer::Role::state_machine;
  // A standby on a thread of its own.
  void stand_by() {
    standby_ = std::thread([this] {
      auto held = take_role(name_, kRole, "state-machine", true);
      if (held && *held) held_.emplace(std::move(**held));
      has_it_ = true;
    });
  }
  // Until the standby has an entry in the process table, thus has found the role held.
  void await_standby(const databuffer::Session& session) const {
    while (true) {
      for (const auto& process : session.processes())
        if (process.name == "state-machine standby") return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void TearDown() override {
    if (standby_.joinable()) standby_.join();
  }

  std::thread standby_;
  std::optional<HeldRole> held_;
  std::atomic<bool> has_it_ = false;
};

TEST_F(RoleTest, WithoutStandbyAHeldRoleIsAUsageError) {
  const auto first = take_role(name_, kRole, "state-machine", false);
  ASSERT_TRUE(first && *first);
  const auto second = take_role(name_, kRole, "state-machine", false);
  ASSERT_FALSE(second);
  EXPECT_TRUE(second.error().bad_usage());
}

TEST_F(RoleTest, AStandbyTakesTheRoleWhenItsHolderHasEnded) {
  auto first = take_role(name_, kRole, "state-machine", false);
  ASSERT_TRUE(first && *first);
  stand_by();
  await_standby((*first)->session);
  EXPECT_FALSE(has_it_);
  (*first)->claim = {};
  standby_.join();
  EXPECT_TRUE(held_.has_value());
}

// The gateway held the role for another host, died, and was started again: the standby has left the role to it.
TEST_F(RoleTest, AStandbyLeavesAMirroredRoleToARestartedGateway) {
  auto gateway = open("gateway");
  auto gateway_claim = std::optional(*gateway.claim(databuffer::Role::gateway));
  auto claim = std::optional(*gateway.claim(kRole));
  gateway.layout().network.mirrored_roles = 1U << static_cast<unsigned>(kRole);
  stand_by();
  await_standby(gateway);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // longer than a standby waits for a dead gateway
  const std::int64_t died_ns = databuffer::monotonic_ns();
  claim.reset();
  gateway_claim.reset();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  gateway_claim.emplace(*gateway.claim(databuffer::Role::gateway));
  auto again = gateway.claim(kRole);
  const bool in_time =
      databuffer::monotonic_ns() - died_ns < 1'000'000'000;  // else this machine was too slow for the test
  EXPECT_TRUE(again || !in_time);
  gateway.layout().network.mirrored_roles = 0;
  again = tl::unexpected(error::Error{});
  gateway_claim.reset();
  standby_.join();
  EXPECT_TRUE(held_.has_value());
}

TEST_F(RoleTest, ARoleYieldsOnlyWhileAGatewayRuns) {
  auto session = open("gateway");
  session.layout().network.yielding_roles = 1U << static_cast<unsigned>(kRole);
  EXPECT_FALSE(session.must_yield(kRole));
  const auto gateway = session.claim(databuffer::Role::gateway);
  EXPECT_TRUE(session.must_yield(kRole));
  EXPECT_FALSE(session.must_yield(databuffer::Role::radar_model));
}

}  // namespace
}  // namespace yars::runtime
