// How a role of a lockstep run over several hosts ends when the gateway says that the host of another role is gone.
#include "runtime/tick_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tests/databuffer/session/open_session.hpp"

namespace yars::runtime {
namespace {

using ::testing::HasSubstr;

// A radar model here. The state machine runs on host beta, and has done tick 41.
class LostRoleTest : public databuffer::testing::OpenSessionTest {
 protected:
  static constexpr std::size_t kMachine = 2, kModel = 3;

  LostRoleTest()
      : session_(open("radar-model")),
        loop_(*TickLoop::create(session_, databuffer::LockstepRole::radar_model, "state-machine,radar-model@100")) {
    databuffer::NetworkStatus status{};
    status.host_count = 2;
    std::strcpy(status.hosts[0].name, "alpha");
    std::strcpy(status.hosts[1].name, "beta");
    session_.layout().network_status.publish(status);
    auto& lockstep = session_.layout().lockstep;
    complete_tick(lockstep, kMachine, 41);
    complete_tick(lockstep, kModel, 41);
    loop_ = *TickLoop::create(session_, databuffer::LockstepRole::radar_model, "state-machine,radar-model@100");
  }
  void lose(std::size_t role, std::uint32_t host) {
    session_.layout().network.lost_role = static_cast<std::uint32_t>(role + 1) | host << 8;
  }

  databuffer::Session session_;
  TickLoop loop_;
};

TEST_F(LostRoleTest, TheWaitEndsAndNamesRoleHostAndTick) {
  lose(kMachine, 1);
  EXPECT_FALSE(loop_.wait());
  ASSERT_FALSE(loop_.outcome());
  EXPECT_THAT(loop_.outcome().error().message(), HasSubstr("expected state-machine of host beta to do tick 42"));
  EXPECT_THAT(loop_.outcome().error().message(), HasSubstr("gone for 10 s; start all roles again"));
}

TEST_F(LostRoleTest, AHostThatIsNotInTheStatusHasNoName) {
  for (const std::uint32_t host : {0U, 2U, 255U}) {
    loop_ = *TickLoop::create(session_, databuffer::LockstepRole::radar_model, "state-machine,radar-model@100");
    lose(kMachine, host);
    EXPECT_FALSE(loop_.wait());
    EXPECT_THAT(loop_.outcome().error().message(), HasSubstr("state-machine of another host to do tick 42"));
  }
}

TEST_F(LostRoleTest, ATickThatIsDoneIsNotAwaited) {
  lose(kMachine, 1);
  complete_tick(session_.layout().lockstep, kMachine, 42);
  const auto due = loop_.wait();
  ASSERT_TRUE(due);
  EXPECT_EQ(due->tick, 42);
  EXPECT_TRUE(loop_.outcome());
}

// Else damage in the segment would end a run.
TEST_F(LostRoleTest, ARoleThatHasNothingToDoIsNotLost) {
  constexpr std::size_t kRecorder = 5, kNoRole = 200;
  complete_tick(session_.layout().lockstep, kMachine, 100);
  complete_tick(session_.layout().lockstep, kModel, 99);
  loop_ = *TickLoop::create(session_, databuffer::LockstepRole::radar_model, "state-machine,radar-model@100");
  for (const std::size_t role : {kMachine, kRecorder, kNoRole}) {
    lose(role, 1);
    EXPECT_TRUE(role != kMachine || loop_.wait());
  }
  complete_tick(session_.layout().lockstep, kModel, 100);
  EXPECT_FALSE(loop_.wait());
  EXPECT_TRUE(loop_.outcome());
}

}  // namespace
}  // namespace yars::runtime
