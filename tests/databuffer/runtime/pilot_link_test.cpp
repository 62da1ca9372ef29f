// Input lane of a program with a display, and which roles live.
#include "databuffer/runtime/pilot_link.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/databuffer/session/open_session.hpp"

namespace yars::databuffer {
namespace {

class PilotLink : public testing::OpenSessionTest {
 protected:
  static InputEvent freeze() {
    InputEvent event{};
    event.kind = static_cast<std::uint16_t>(EventKind::freeze);
    return event;
  }
  // All events that wait in all lanes.
  static std::vector<InputEvent> waiting(Session& session) {
    std::vector<InputEvent> events;
    InputEvent event{};
    for (std::size_t lane = 0; lane < kInputLanes; ++lane)
      while (session.layout().input.pop(lane, event)) events.push_back(event);
    return events;
  }
};

TEST_F(PilotLink, EventsAreNumberedAndStampedInTheirOrder) {
  Session session = open();
  auto lane = InputLane::claim(session, "tester");
  ASSERT_TRUE(lane);
  const std::int64_t before_ns = monotonic_ns();
  lane->send(freeze());
  lane->send(freeze());
  const auto events = waiting(session);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].number, 1U);
  EXPECT_EQ(events[1].number, 2U);
  EXPECT_GE(events[0].monotonic_ns, before_ns);
  EXPECT_LE(events[1].monotonic_ns, monotonic_ns());
}

TEST_F(PilotLink, AFullLaneDropsTheEventAndKeepsTheOthers) {
  Session session = open();
  auto lane = InputLane::claim(session, "tester");
  ASSERT_TRUE(lane);
  for (int i = 0; i < 5000; ++i) lane->send(freeze());
  const auto events = waiting(session);
  ASSERT_LT(events.size(), 5000U);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.front().number, 1U);
  EXPECT_EQ(events.back().number, events.size());
}

TEST_F(PilotLink, ARoleLivesWhileItsHeartbeatIsLessThanASecondOld) {
  constexpr std::int64_t kNow_ns = 10'000'000'000;
  const std::vector<ProcessInfo> processes{{1, "state-machine", kNow_ns - 999'999'999, 0},
                                           {2, "radar-model", kNow_ns - 1'000'000'000, 0}};
  EXPECT_TRUE(is_alive(processes, Role::state_machine, kNow_ns));
  EXPECT_FALSE(is_alive(processes, Role::radar_model, kNow_ns));
  EXPECT_FALSE(is_alive(processes, Role::recorder, kNow_ns));
}

}  // namespace
}  // namespace yars::databuffer
