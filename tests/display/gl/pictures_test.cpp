// Tests that draw all display formats and colour schemes. With YARS_PICTURES=FOLDER in the environment, the pictures
// are also written to that folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "display/gl/context.hpp"
#include "display/gl/display.hpp"
#include "lib/radar/configuration.hpp"
#include "tests/display/gl/made_up_map.hpp"
#include "tests/display/gl/made_up_sweeps.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display::gl {
namespace {

using radar::Mode;
using testing::kAircraftPosition;

constexpr double kPictureRange_m = 40.0 * geo::kMetresPerNauticalMile;
constexpr double kPictureTrack_deg = 30.0;

// Adds a scan of made-up ground, with sweeps of width_deg. In the HRM PPI the blind zone has no video.
void add_scan(Display& radar_display, Mode mode, double width_deg) {
  const double from_deg = kPictureTrack_deg - 50.0;
  for (double left_deg = from_deg; left_deg < kPictureTrack_deg + 50.0 - 1e-9; left_deg += width_deg) {
    databuffer::Sweep sweep =
        testing::blank_sweep(kAircraftPosition, left_deg, left_deg + width_deg, kPictureRange_m, 480);
    sweep.mode = static_cast<std::uint8_t>(mode);
    const double angle = left_deg * geo::kRadiansPerDegree;
    const bool blind = mode == Mode::hrm && std::abs(left_deg + width_deg / 2.0 - kPictureTrack_deg) < 8.0;
    for (std::uint32_t i = 0; i < 480 && !blind; ++i) {
      const double x = 0.5 + i / 960.0 * std::sin(angle), y = 1.0 - i / 480.0 * std::cos(angle);
      const double level = testing::ground_at(x, y) *
                           (0.6 + 0.8 * testing::speckle(static_cast<int>(left_deg * 7), static_cast<int>(i)));
      sweep.video[i] = static_cast<std::uint8_t>(255.0 * std::min(1.0, level));
    }
    radar_display.add(sweep);
  }
}

void add_points(DisplayInput& input) {
  using radar::PointKind;
  testing::add_point(input, "1", PointKind::steer, testing::at(20.0, 15.0));
  testing::add_point(input, "1.1", PointKind::steer_offset, testing::at(38.0, 17.0));
  testing::add_point(input, "2", PointKind::initial, testing::at(10.0, 25.0));
  testing::add_point(input, "3.", PointKind::target, testing::at(61.0, 20.4));
  testing::add_point(input, "3.01", PointKind::target_offset, testing::at(58.0, 19.0));
}

DisplayInput operating(Mode mode) {
  DisplayInput input = testing::operating(mode, 40.0);
  testing::put_cursor(input, 60.0, 20.0);
  add_points(input);
  input.model.antenna_azimuth_deg = 22.0;
  input.model.antenna_elevation_deg = -3.0;
  input.model.scan_centre_deg = kPictureTrack_deg;
  input.model.scan_width_deg = 100.0;
  input.ownship.pitch_deg = 2.0;
  return input;
}

DisplayInput operating_with_map(Mode mode) {
  DisplayInput input = operating(mode);
  testing::put_map(input, 60.0, 20.0, 4.7);
  return input;
}

// Freezes the picture; `recall` is the legend of PB 10: NEW, OLD or STORE.
void freeze(DisplayInput& input, const char* recall) {
  input.state.flags |= databuffer::kFreeze;
  testing::set_text(input.state.legends[10], recall);
}

void put_map_in_formation(DisplayInput& input, double bearing_deg, double range_nm, double window_nm) {
  testing::put_forming_map(input, bearing_deg, range_nm, window_nm);
  input.model.map_timer_s = 6.4;
  input.model.map_progress = 0.4;
}

// A designated target, and four other points within 1.5 NM of it.
void add_crowded_points(DisplayInput& input, double bearing_deg, double range_nm, databuffer::SteeringLine line) {
  using radar::PointKind;
  input.state.points_drawn = 0;
  testing::add_point(input, "11", PointKind::steer, testing::at(bearing_deg, range_nm + 1.2));
  testing::add_point(input, "12", PointKind::initial, testing::at(bearing_deg + 0.8, range_nm - 0.3));
  testing::add_point(input, "13.", PointKind::target, testing::at(bearing_deg, range_nm));
  testing::add_point(input, "13.01", PointKind::target_offset, testing::at(bearing_deg - 0.5, range_nm + 0.4));
  testing::add_point(input, "13.02", PointKind::target_offset, testing::at(bearing_deg + 0.4, range_nm + 0.7));
  testing::put_target(input, testing::at(bearing_deg, range_nm), 60.0, line);
  testing::set_text(input.state.target_name, "13.");
}

struct Picture {
  const char* name;
  std::function<DisplayInput()> input;
};

const std::vector<Picture>& pictures() {
  static const std::vector<Picture> all{
      {"rbm", [] { return operating(Mode::rbm); }},
      {"rbm_map_forms",
       [] {
         DisplayInput input = operating(Mode::rbm);
         put_map_in_formation(input, 60.0, 20.0, 4.7);
         return input;
       }},
      {"rbm_rejected",
       [] {
         DisplayInput input = operating(Mode::rbm);
         testing::set_text(input.state.message, "BLIND ZONE");
         return input;
       }},
      {"hrm_ppi",
       [] {
         DisplayInput input = operating(Mode::hrm);
         input.model.map_timer_s = 8.0;
         return input;
       }},
      {"hrm_ppi_map_forms",
       [] {
         DisplayInput input = operating(Mode::hrm);
         put_map_in_formation(input, 0.0, 25.0, 10.0);
         return input;
       }},
      {"patch",
       [] {
         DisplayInput input = operating_with_map(Mode::patch);
         input.model.map_timer_s = 8.0;
         return input;
       }},
      {"patch_next_forms",
       [] {
         DisplayInput input = operating_with_map(Mode::patch);
         put_map_in_formation(input, 61.0, 20.5, 1.3);
         return input;
       }},
      {"patch_frozen_store",
       [] {
         DisplayInput input = operating_with_map(Mode::patch);
         freeze(input, "STORE");
         input.state.boxed = 1U << 15U;
         return input;
       }},
      {"air_to_air_set",
       [] {
         DisplayInput input = operating_with_map(Mode::air_to_air);
         input.state.flags |= databuffer::kFreeze;
         input.state.boxed = 1U << 18U;
         return input;
       }},
      {"bcn", [] { return operating(Mode::beacon); }},
      {"rbm_update",
       [] {
         DisplayInput input = operating(Mode::rbm);
         testing::put_update(input, 1240.0, -330.0, -1);
         return input;
       }},
      {"hrm_update_ins_ipvu",
       [] {
         DisplayInput input = operating(Mode::hrm);
         testing::put_update(input, 12'400.0, -3'300.0, 17);
         testing::put_velocities(input, 1.2, -0.4, 0.1);
         return input;
       }},
      {"rbm_steering_line",
       [] {
         DisplayInput input = operating(Mode::rbm);
         const geo::GeoPoint position = testing::at(22.0, 22.0);
         testing::add_point(input, "4.", radar::PointKind::target, position);
         testing::put_target(input, position, 85.0, databuffer::SteeringLine::slewing);
         return input;
       }},
      {"rbm_heap_of_points",
       [] {
         DisplayInput input = operating(Mode::rbm);
         add_crowded_points(input, 25.0, 24.0, databuffer::SteeringLine::slewing);
         testing::put_cursor(input, 25.8, 23.7);
         return input;
       }},
      {"rbm_heap_at_160",
       [] {
         DisplayInput input = testing::operating(Mode::rbm, 160.0);
         add_crowded_points(input, 38.0, 95.0, databuffer::SteeringLine::fixed);
         testing::put_cursor(input, 38.0, 95.0);
         return input;
       }},
      {"rbm_below_the_apex",
       [] {
         DisplayInput input = operating(Mode::rbm);
         input.state.points_drawn = 0;
         testing::add_point(input, "1", radar::PointKind::steer, testing::at(220.0, 1.2));
         testing::add_point(input, "2", radar::PointKind::steer, testing::at(160.0, 1.5));
         testing::put_cursor(input, 212.0, 1.1);
         return input;
       }},
      {"hrm_corner",
       [] {
         DisplayInput input = operating(Mode::hrm);
         testing::put_velocities(input, 1.2, -0.4, 0.1);
         add_crowded_points(input, 59.8, 39.0, databuffer::SteeringLine::line_of_sight);
         testing::put_cursor(input, -2.5, 40.0);
         return input;
       }},
      {"patch_steering_line",
       [] {
         DisplayInput input = operating_with_map(Mode::patch);
         testing::put_target(input, testing::at(60.5, 19.6), 350.0, databuffer::SteeringLine::fixed);
         testing::add_point(input, "4.", radar::PointKind::target, testing::at(60.5, 19.6));
         return input;
       }},
      {"pvu",
       [] {
         DisplayInput input = operating(Mode::pvu);
         testing::put_velocities(input, 1.2, -12.4, 0.1);
         input.model.velocity_beam = 2;
         return input;
       }},
      {"pvu_before_the_first", [] { return operating(Mode::pvu); }},
      {"standby", [] {
         DisplayInput input = operating_with_map(Mode::patch);
         input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
         return input;
       }}};
  return all;
}

TEST(Pictures, EveryFormatIsDrawn) {
  auto context = open_headless();
  if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
  const char* folder = std::getenv("YARS_PICTURES");
  const auto ground = testing::made_up_ground(480);
  for (const int size : {480, 1024}) {
    int number = 0;
    for (const Picture& picture : pictures()) {
      if (size != 480 && folder == nullptr && number++ % 4 != 0) continue;
      const DisplayInput input = picture.input();
      Display radar_display(radar::RadarConfiguration(), size);
      radar_display.keep_video(false);  // as in files
      const auto mode = static_cast<Mode>(input.state.mode);
      add_scan(radar_display, mode, mode == Mode::hrm ? 0.14 : 0.5);
      radar_display.add(input.map, ground);
      EXPECT_TRUE(radar_display.draw(input)) << picture.name;
      const imageio::Image image = radar_display.read();
      EXPECT_TRUE(std::ranges::any_of(image.pixels, [](std::uint8_t value) { return value > 150; })) << picture.name;
      if (folder == nullptr) continue;
      const std::string path = std::string(folder) + "/" + picture.name + "_" + std::to_string(size) + ".png";
      const auto written = imageio::write_png(path, image);
      EXPECT_TRUE(written) << path;
    }
  }
}

TEST(Pictures, EveryColorSchemeIsDrawn) {
  auto context = open_headless();
  if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
  const char* folder = std::getenv("YARS_PICTURES");
  std::vector<imageio::Image> drawn;
  for (const char* name : {"green", "gray", "night"}) {
    radar::RadarConfiguration configuration;
    configuration.view.colors = radar::color_preset(static_cast<radar::ColorPreset>(drawn.size()));
    configuration.view.arc_spacing_nm = {5.0};
    Display radar_display(configuration, 480);
    add_scan(radar_display, Mode::rbm, 0.5);
    EXPECT_TRUE(radar_display.draw(operating(Mode::rbm))) << name;
    drawn.push_back(radar_display.read());
    if (folder == nullptr) continue;
    const std::string path = std::string(folder) + "/scheme_" + name + ".png";
    EXPECT_TRUE(imageio::write_png(path, drawn.back())) << path;
  }
  EXPECT_NE(drawn[0].pixels, drawn[1].pixels);
  EXPECT_NE(drawn[1].pixels, drawn[2].pixels);
}

}  // namespace
}  // namespace yars::display::gl
