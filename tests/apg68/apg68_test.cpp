// Tests of config/apg68.guf, a second radar that differs from the APG-70 by its configuration file alone. The tests run
// it in the configuration reader, the state machine, the radar kernel and the display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "display/gl/context.hpp"
#include "display/gl/display.hpp"
#include "model/antenna/antenna.hpp"
#include "tests/apg68/radar.hpp"

namespace yars::apg68 {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Apg68, LoadsWithoutWarnings) {
  const auto loaded = config::load_configuration(std::string(YARS_SOURCE_DIR) + "/config/apg68.guf");
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_THAT(loaded->warnings, IsEmpty());
  EXPECT_THAT(loaded->radar.ranges_nm, ElementsAre(10, 20, 40, 80));
  EXPECT_THAT(loaded->radar.scan_widths_deg, ElementsAre(120, 60, 20));
  EXPECT_EQ(loaded->radar.antenna.scan_bars, 4);
}

TEST(Apg68, PowersUpWithTheSettingsOfItsFile) {
  Radar radar;
  radar.step();
  EXPECT_EQ(radar.around.model.antenna_elevation_deg, -3.0) << "the antenna keeps its start elevation until it scans";
  radar.send("power opr");
  radar.step();
  EXPECT_EQ(radar.state.range_nm, 40.0) << "10,000 ft is above the last height of the table";
  EXPECT_EQ(radar.state.window_nm, 5.0);
  EXPECT_EQ(radar.state.antenna_elevation_deg, -3.0);
}

TEST(Apg68, SelectsTheRangeFromItsOwnHeightTable) {
  for (const auto& [height_ft, range_nm] : {std::pair{1000.0, 10.0}, {1001.0, 20.0}, {5000.0, 20.0}, {5001.0, 40.0}}) {
    Radar radar;
    radar.around.ownship.radar_altitude_m = height_ft * geo::kMetresPerFoot;
    radar.send("power opr");
    radar.step();
    EXPECT_EQ(radar.state.range_nm, range_nm) << height_ft;
  }
}

TEST(Apg68, StepsThroughFourRangesThreeScanWidthsAndFiveWindows) {
  Radar radar;
  radar.send("power opr");
  radar.step();
  std::vector<double> ranges_nm{radar.state.range_nm};
  while (radar.send("pb 14")) ranges_nm.push_back(radar.state.range_nm);
  while (radar.send("pb 13")) ranges_nm.push_back(radar.state.range_nm);
  EXPECT_THAT(ranges_nm, ElementsAre(40, 20, 10, 20, 40, 80));
  std::vector<double> widths_deg;
  for (int i = 0; i < 3; ++i) {
    radar.send("pb 9");
    widths_deg.push_back(radar.state.scan_width_deg);
  }
  EXPECT_THAT(widths_deg, ElementsAre(60, 20, 120));
  std::vector<double> windows_nm{radar.state.window_nm};
  while (radar.send("acq aft")) windows_nm.push_back(radar.state.window_nm);
  while (radar.send("acq fwd")) windows_nm.push_back(radar.state.window_nm);
  EXPECT_THAT(windows_nm, ElementsAre(5, 2.5, 1, 0, 1, 2.5, 5, 10, 20));
}

TEST(Apg68, ScansEachWidthInFourBars) {
  for (const double width_deg : {120.0, 60.0, 20.0}) {
    Radar radar;
    radar.send("power opr");
    if (width_deg < 120.0) radar.send("pb 9");
    if (width_deg < 60.0) radar.send("pb 9");
    ASSERT_EQ(radar.state.scan_width_deg, width_deg);
    const auto first = radar.scan();
    const auto sweeps = radar.scan();
    ASSERT_FALSE(first.empty() || sweeps.empty());
    // Four bars at 110 deg/s; the turn-around adds a tenth to each.
    const double scan_s = 4.0 * 1.1 * width_deg / 110.0;
    const auto ticks = static_cast<double>(sweeps.front().tick - first.front().tick);
    EXPECT_NEAR(ticks * radar::kTickSeconds, scan_s, 0.03);
    EXPECT_EQ(sweeps.front().scan, sweeps.back().scan);
    std::vector<double> elevations_deg;
    double least_deg = 0.0, greatest_deg = 0.0;
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      // The last sweep of a bar: during the first ones the antenna may still move to the elevation of the bar.
      if (i + 1 == sweeps.size() || sweeps[i].direction != sweeps[i + 1].direction)
        elevations_deg.push_back(sweeps[i].elevation_deg);
      EXPECT_EQ(sweeps[i].flags & databuffer::kSweepBlank, 0U) << "blank without drift: sweep " << i;
      const geo::Bearing track = geo::Bearing::degrees(20.0);
      least_deg = std::min(least_deg, (geo::Bearing::degrees(sweeps[i].azimuth_left_deg) - track).degrees());
      greatest_deg = std::max(greatest_deg, (geo::Bearing::degrees(sweeps[i].azimuth_right_deg) - track).degrees());
    }
    EXPECT_THAT(elevations_deg, ::testing::Pointwise(::testing::DoubleNear(1e-9), {3.9, -0.7, -5.3, -9.9}));
    EXPECT_NEAR(greatest_deg, 0.5 * width_deg, 1e-6);
    EXPECT_NEAR(least_deg, -0.5 * width_deg, 1e-6);
  }
}

// The elevation caret of the display shows this angle.
TEST(Apg68, ReportsTheElevationOfTheCurrentBar) {
  Radar radar;
  radar.send("power opr");
  radar.scan();
  std::map<int, double> bar_elevation_deg;
  for (int i = 0; i < 960; ++i) {  // ticks of 5 ms: one scan of 4.8 s
    radar.step();
    const databuffer::ModelStatus& model = radar.around.model;
    const bool sweeping = model.antenna_phase == static_cast<std::uint8_t>(model::antenna::Phase::sweeping);
    if (sweeping) bar_elevation_deg[model.scan_bar] = model.antenna_elevation_deg;
  }
  const std::map<int, double> expected_deg{{0, 3.9}, {1, -0.7}, {2, -5.3}, {3, -9.9}};
  ASSERT_EQ(bar_elevation_deg.size(), expected_deg.size());
  for (const auto& [bar, elevation_deg] : expected_deg)
    EXPECT_NEAR(bar_elevation_deg.at(bar), elevation_deg, 1e-9) << bar;
}

TEST(Apg68, ScansOneBarInTheHrmPpi) {
  Radar radar;
  radar.send("power opr");
  radar.send("radar hrm");
  radar.put_cursor(30.0, 20.0);
  radar.scan();
  const auto sweeps = radar.scan();
  ASSERT_FALSE(sweeps.empty());
  for (const databuffer::Sweep& sweep : sweeps) EXPECT_NEAR(sweep.elevation_deg, sweeps.front().elevation_deg, 0.2);
}

TEST(Apg68, AppliesItsOwnRangeLimitsToEachWindow) {
  struct Case {
    double window_nm, range_nm;
    const char* why_not;
  };
  Radar radar;
  radar.send("power opr");
  radar.send("pb 13");
  for (const Case& one :
       {Case{1, 4.9, "MIN RANGE"}, Case{1, 5.1, ""}, Case{1, 19.9, ""}, Case{1, 20.1, "MAX RANGE"}, Case{2.5, 39.9, ""},
        Case{2.5, 40.1, "MAX RANGE"}, Case{20, 19.9, "MIN RANGE"}, Case{20, 79.9, ""}, Case{0, 2.9, "NO WINDOW"},
        Case{0, 3.1, ""}, Case{0, 80.1, "NO WINDOW"}}) {
    radar.state.window_nm = one.window_nm;
    radar.put_cursor(30.0, one.range_nm);
    EXPECT_STREQ(radar.around.model.why_not, one.why_not) << one.window_nm << " at " << one.range_nm;
  }
}

TEST(Apg68, ABlankWindowIsReplacedByTheTableEntryForTheCursorRange) {
  for (const auto& [range_nm, window_nm] : {std::pair{19.9, 2.5}, {20.1, 5.0}, {41.0, 10.0}}) {
    Radar radar;
    radar.send("power opr");
    radar.send("pb 13");
    while (radar.send("acq aft")) {
    }
    radar.put_cursor(30.0, range_nm);
    ASSERT_TRUE(radar.send("tdc release")) << range_nm;
    EXPECT_EQ(radar.state.map_window_nm, window_nm) << range_nm;
  }
}

// The aircraft flies past an airfield that it re-maps. At the gimbal limit the re-maps stop, the message GIMBAL appears
// and the last map stays. A turn towards the airfield clears the message, and re-maps resume.
TEST(Apg70, ReMapsOfAnAirfieldStopAtTheGimbalLimitAndResumeAfterATurn) {
  Radar radar(configuration_of("apg70.guf"));
  radar.send("power opr");
  radar.send("pb 13");
  radar.put_cursor(40.0, 12.0);
  const geo::GeoPoint airfield{radar.state.cursor_latitude_deg, radar.state.cursor_longitude_deg};
  ASSERT_TRUE(radar.send("tdc release"));
  const auto off_nose_deg = [&] {
    const geo::GeoPoint at{radar.around.ownship.latitude_deg, radar.around.ownship.longitude_deg};
    return (geo::geodesic_inverse(at, airfield).azimuth_at_start - geo::Bearing::degrees(20.0)).degrees();
  };
  std::uint64_t newest_within_limit = 0;
  std::uint64_t newest_beyond_limit = 0;
  int stopped_ticks = 0;
  for (int tick = 0; tick < 40'000 && off_nose_deg() < 122.0; ++tick) {
    radar.fly(220.0 * radar::kTickSeconds);
    radar.step_with_maps();
    if (off_nose_deg() < 59.5) {
      newest_within_limit = radar.around.model.map_newest;
      EXPECT_STREQ(radar.state.message, "") << off_nose_deg();
    } else if (off_nose_deg() > 63.0) {
      ++stopped_ticks;
      ASSERT_STREQ(radar.state.message, "GIMBAL") << off_nose_deg();
      if (stopped_ticks == 1) newest_beyond_limit = radar.around.model.map_newest;
      ASSERT_EQ(radar.around.model.map_newest, newest_beyond_limit)
          << "after the limit only the map in progress is completed";
      EXPECT_EQ(radar.around.model.map_window_nm, 0.0);
    }
  }
  ASSERT_GT(newest_within_limit, 2U);
  ASSERT_GT(stopped_ticks, 100);
  EXPECT_EQ(radar.state.mode, static_cast<std::uint8_t>(radar::Mode::patch));
  EXPECT_EQ(radar.state.map_shown, radar.around.model.map_newest) << "the old map stays";
  const std::uint64_t newest_before_turn = radar.around.model.map_newest;
  radar.turn_to(120.0);
  for (int tick = 0; tick < 4000; ++tick) radar.step_with_maps();
  EXPECT_STREQ(radar.state.message, "");
  EXPECT_GT(radar.around.model.map_newest, newest_before_turn);
}

// With YARS_PICTURES=FOLDER in the environment, the test also writes the pictures to that folder for inspection.
TEST(Apg68, DrawsSweepsOnTheDisplay) {
  auto context = display::gl::open_headless();
  if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
  const char* folder = std::getenv("YARS_PICTURES");
  Radar radar;
  display::gl::Display radar_display(radar.configuration, 480);
  radar.send("power opr");
  radar.put_cursor(25.0, 25.0);
  int picture = 0;
  for (const char* event : {"elevation -3", "pb 9", "pb 14", "radar hrm"}) {
    radar.send(event);
    // Two complete scans and 1.7 s of a third, so that the picture shows a bar in progress.
    std::size_t sweeps = 0;
    for (const bool complete : {true, true, false}) {
      const auto new_sweeps = complete ? radar.scan() : radar.run(1.7);
      for (const databuffer::Sweep& sweep : new_sweeps) radar_display.add(sweep);
      sweeps += new_sweeps.size();
    }
    EXPECT_GT(sweeps, 100U) << event;
    EXPECT_TRUE(radar_display.draw(radar.display_input())) << event;
    const imageio::Image image = radar_display.read();
    EXPECT_TRUE(std::ranges::any_of(image.pixels, [](std::uint8_t value) { return value > 150; })) << event;
    if (folder == nullptr) continue;
    const std::string path = std::string(folder) + "/apg68_" + std::to_string(++picture) + ".png";
    EXPECT_TRUE(imageio::write_png(path, image)) << path;
  }
}

}  // namespace
}  // namespace yars::apg68
