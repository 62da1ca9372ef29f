// Tests of values derived from records: the map timer and the ground track.
#include "databuffer/messages/derived_values.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lib/radar/modes.hpp"

namespace yars::databuffer {
namespace {

// A state in which the timer is shown (docs/pilots_manual.md#rule-6): cursor function MAP, a selected window,
// and a cursor at which a map may be made.
class MapTimer : public ::testing::Test {
 protected:
  MapTimer() {
    state.window_nm = 4.7;
    model.mappable = 1;
    model.map_timer_s = 7.5;
  }
  RadarState state{};
  ModelStatus model{};
};

TEST_F(MapTimer, IsTheModelsEstimateAtTheCursor) {
  EXPECT_EQ(map_timer_s(state, model), 7.5);
}

TEST_F(MapTimer, IsAbsentWithoutAnEstimateOfTheModel) {
  model.map_timer_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(map_timer_s(state, model), std::nullopt);
}

TEST_F(MapTimer, IsAbsentWithAnotherCursorFunctionABlankWindowOrAnUnmappableCursor) {
  RadarState update = state;
  update.cursor_function = static_cast<std::uint8_t>(radar::CursorFunction::update);
  EXPECT_EQ(map_timer_s(update, model), std::nullopt);
  RadarState blank = state;
  blank.window_nm = 0.0;
  EXPECT_EQ(map_timer_s(blank, model), std::nullopt);
  model.mappable = 0;
  EXPECT_EQ(map_timer_s(state, model), std::nullopt);
}

TEST_F(MapTimer, IsPresentWhileAMapFormsForAnyCursor) {
  state.cursor_function = static_cast<std::uint8_t>(radar::CursorFunction::target);
  model.mappable = 0;
  model.map_window_nm = 0.67;
  EXPECT_EQ(map_timer_s(state, model), 7.5);
}

TEST_F(MapTimer, IsPresentOnlyInRbmHrmPpiAndPatchMap) {
  for (const auto mode : {radar::Mode::beacon, radar::Mode::pvu, radar::Mode::air_to_air, radar::Mode::ranging}) {
    state.resume_mode = static_cast<std::uint8_t>(mode);
    EXPECT_EQ(map_timer_s(state, model), std::nullopt) << radar::name_of(mode);
  }
  for (const auto mode : {radar::Mode::rbm, radar::Mode::hrm, radar::Mode::patch}) {
    state.resume_mode = static_cast<std::uint8_t>(mode);
    EXPECT_TRUE(map_timer_s(state, model).has_value()) << radar::name_of(mode);
  }
}

TEST(GroundTrack, IsTheDirectionOfTheVelocityOrTheHeadingAtRest) {
  const auto track_deg = [](double north_mps, double east_mps) {
    return radar::ground_track(geo::Speed::metres_per_second(north_mps), geo::Speed::metres_per_second(east_mps),
                               geo::Bearing::degrees(77.0))
        .degrees();
  };
  EXPECT_NEAR(track_deg(100.0, 100.0), 45.0, 1e-9);
  EXPECT_NEAR(track_deg(0.0, -100.0), 270.0, 1e-9);
  EXPECT_EQ(track_deg(0.1, -0.1), 77.0);
}

}  // namespace
}  // namespace yars::databuffer
