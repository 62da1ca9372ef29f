// StatePace: the selection of radar states that are recorded.
#include <gtest/gtest.h>

#include <functional>

#include "radar/recording/recorded_kinds.hpp"

namespace yars::recording {
namespace {

using databuffer::RadarState;

// Number of states taken over `ticks` ticks, if `move` changes the state before each tick.
int taken_of(int ticks, const std::function<void(RadarState&, int)>& move) {
  StatePace pace;
  RadarState state{};
  int taken = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    move(state, tick);
    if (pace.takes(state, tick)) ++taken;
  }
  return taken;
}

TEST(StatePace, TakesAConstantStateOnce) {
  EXPECT_EQ(taken_of(2000, [](RadarState&, int) {}), 1);
}

TEST(StatePace, TakesAStateWithMovingValuesTenTimesASecond) {
  EXPECT_EQ(taken_of(2000,
                     [](RadarState& state, int tick) {
                       state.tick = tick;
                       state.cursor_bearing_deg = 0.01 * tick;
                       state.cursor_range_nm = 0.02 * tick;
                       state.frame_latitude_deg = 1e-5 * tick;
                       state.points[3].elevation_m = tick;
                       state.ins.north_m = 0.1 * tick;
                       state.update_east_m = 0.1 * tick;
                       state.steering_line_deg = 0.1 * tick;
                     }),
            100);
}

TEST(StatePace, TakesEveryStateWithASwitchedControl) {
  EXPECT_EQ(taken_of(200, [](RadarState& state, int tick) { state.gain = static_cast<std::uint8_t>(tick); }), 200);
  EXPECT_EQ(taken_of(200, [](RadarState& state, int tick) { state.flags = static_cast<std::uint32_t>(tick); }), 200);
  EXPECT_EQ(taken_of(200, [](RadarState& state, int tick) { state.antenna_elevation_deg = tick; }), 200);
  EXPECT_EQ(taken_of(200, [](RadarState& state, int tick) { state.message[0] = static_cast<char>(tick % 100); }), 200);
}

TEST(StatePace, TakesASkippedStateAtALaterTick) {
  StatePace pace;
  RadarState state{};
  EXPECT_TRUE(pace.takes(state, 100));
  state.cursor_bearing_deg = 5.0;
  for (int tick = 101; tick < 120; ++tick) EXPECT_FALSE(pace.takes(state, tick)) << tick;
  EXPECT_TRUE(pace.takes(state, 120));
  EXPECT_FALSE(pace.takes(state, 140));
}

TEST(StatePace, TakesAStateWhenTicksGoBackwards) {
  StatePace pace;
  RadarState state{};
  EXPECT_TRUE(pace.takes(state, 100'000));
  state.cursor_bearing_deg = 5.0;
  EXPECT_TRUE(pace.takes(state, 0));
}

}  // namespace
}  // namespace yars::recording
