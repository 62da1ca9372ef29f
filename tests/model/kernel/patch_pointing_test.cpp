// Pointing of the antenna: at the map's centre in mode PATCH, at the cursor's elevation in mode HRM.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "model/kernel/doppler_modes.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::test {
namespace {

using databuffer::ModelStatus;
using radar::Mode;

constexpr double kGround_m = 100.0;  // [m MSL] elevation of the cockpit's terrain

// Cockpit with a commanded patch map 20 NM away at a true bearing. The ground track is 45 degrees.
class PatchCockpit : public Cockpit {
 public:
  explicit PatchCockpit(double bearing_deg = 85.0, double velocity_period_s = 60.0)
      : Cockpit(configuration_with(velocity_period_s)) {
    const geo::GeoPoint target =
        geo::geodesic_direct(position(), geo::Bearing::degrees(bearing_deg), geo::Length::nautical_miles(20.0));
    tick.command.map_latitude_deg = target.latitude_deg;
    tick.command.map_longitude_deg = target.longitude_deg;
    tick.command.map_window_nm = 4.7F;
    tick.command.map_request = 1;
    tick.command.mode = static_cast<std::uint8_t>(Mode::patch);
  }
  static radar::RadarConfiguration configuration_with(double velocity_period_s) {
    radar::RadarConfiguration configuration;
    configuration.fidelity.samples = 32;
    configuration.navigation.velocity_period_s = velocity_period_s;
    return configuration;
  }
  geo::GeoPoint position() const { return {tick.ownship.latitude_deg, tick.ownship.longitude_deg}; }
  // Steps many ticks. Each map is completed when it is due.
  void fly(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      tick.flags = databuffer::kTickOwnshipValid;
      if (kernel.maps().due(tick.tick + 1)) tick.flags |= databuffer::kTickMapComplete;
      step();
    }
  }
  // Absolute difference [deg] between the antenna's reported direction and the direction of `target`.
  double azimuth_off(geo::GeoPoint target) const {
    const geo::Bearing wanted = geo::geodesic_inverse(position(), target).azimuth_at_start;
    const geo::Bearing found = geo::Bearing::degrees(tick.ownship.heading_deg + status().antenna_azimuth_deg);
    return std::abs((found - wanted).degrees());
  }
  double elevation_off(geo::GeoPoint target) const {
    const double distance_m = geo::geodesic_inverse(position(), target).distance.metres();
    const double wanted_deg = -std::atan2(tick.ownship.altitude_msl_m - kGround_m, distance_m) / geo::kRadiansPerDegree;
    return std::abs(status().antenna_elevation_deg - wanted_deg);
  }
  geo::GeoPoint commanded() const { return {tick.command.map_latitude_deg, tick.command.map_longitude_deg}; }
};

TEST(PatchPointing, TheAntennaPointsAtTheMapWhileItFormsAndAfterwards) {
  PatchCockpit cockpit;
  cockpit.tick.command.mode = static_cast<std::uint8_t>(Mode::rbm);
  cockpit.set_flag(databuffer::kMapping, true);
  cockpit.fly(150);
  ASSERT_GT(cockpit.status().map_window_nm, 0.0);
  EXPECT_LT(cockpit.azimuth_off(cockpit.commanded()), 0.1);
  EXPECT_LT(cockpit.elevation_off(cockpit.commanded()), 0.1);
  cockpit.set_flag(databuffer::kMapping, false);
  cockpit.tick.command.mode = static_cast<std::uint8_t>(Mode::patch);
  // STAB re-maps the same ground while the aircraft flies on.
  for (int i = 0; i < 20; ++i) {
    cockpit.tick.ownship.latitude_deg += 0.002;
    cockpit.fly(100);
    ASSERT_LT(cockpit.azimuth_off(cockpit.commanded()), 0.1);
    ASSERT_LT(cockpit.elevation_off(cockpit.commanded()), 0.1);
  }
  EXPECT_GT(cockpit.status().map_newest, 0U);
}

TEST(PatchPointing, ProgKeepsTheAngleToTheTrack) {
  PatchCockpit cockpit(85.0);
  cockpit.fly(10);
  cockpit.set_flag(databuffer::kProgressive, true);
  while (cockpit.status().map_newest == 0) cockpit.fly(1);
  for (int i = 0; i < 20; ++i) {
    cockpit.tick.ownship.latitude_deg += 0.005;
    cockpit.fly(static_cast<int>(2.0 * cockpit.status().map_timer_s / radar::kTickSeconds) + 20);
    ASSERT_NEAR(cockpit.status().antenna_azimuth_deg, 40.0, 1.0);
  }
}

TEST(PatchPointing, TheAntennaDoesNotFollowAMapBeyondTheGimbalOrAFrozenMap) {
  PatchCockpit behind(45.0 + 100.0);
  behind.fly(300);
  EXPECT_STREQ(behind.status().map_stopped, "GIMBAL");
  EXPECT_LT(std::abs(behind.status().antenna_azimuth_deg), 1.0);

  PatchCockpit frozen;
  frozen.fly(150);
  while (frozen.kernel.maps().forming()) {
    frozen.set_flag(databuffer::kFreeze, true);
    frozen.fly(1);
  }
  const double before_deg = frozen.status().antenna_azimuth_deg;
  frozen.tick.ownship.latitude_deg += 0.05;
  frozen.fly(300);
  EXPECT_EQ(frozen.status().antenna_azimuth_deg, before_deg);
}

TEST(PatchPointing, TheScanResumesAfterPatch) {
  PatchCockpit cockpit;
  cockpit.fly(300);
  cockpit.tick.command.mode = static_cast<std::uint8_t>(Mode::rbm);
  EXPECT_TRUE(cockpit.run_until(is_scan_end));
  EXPECT_NEAR(cockpit.status().antenna_elevation_deg, cockpit.tick.command.antenna_elevation_deg, 0.1);
}

TEST(PatchPointing, AVelocityUpdateRunsBetweenTwoMaps) {
  PatchCockpit cockpit(85.0, 10.0);
  cockpit.fly(50);
  ASSERT_TRUE(cockpit.kernel.maps().forming());
  cockpit.set_flag(databuffer::kIpvu, true);
  int overlaps = 0, maps = 0;
  std::uint64_t newest = cockpit.status().map_newest;
  for (int i = 0; i < 8000; ++i) {
    cockpit.fly(1);
    const ModelStatus status = cockpit.status();
    overlaps += status.velocity_beam > 0 && status.map_window_nm > 0.0 ? 1 : 0;
    maps += status.map_newest != newest ? 1 : 0;
    newest = status.map_newest;
  }
  EXPECT_EQ(overlaps, 0);
  EXPECT_GE(maps, 2);
  EXPECT_GE(cockpit.status().velocity_count, 2U);
}

TEST(HrmPointing, TheElevationFollowsTheCursorAndNotTheThumbwheel) {
  PatchCockpit cockpit;
  cockpit.tick.command.mode = static_cast<std::uint8_t>(Mode::hrm);
  cockpit.set_flag(databuffer::kCursorValid, true);
  for (const double range_nm : {8.0, 25.0}) {
    const geo::GeoPoint cursor =
        geo::geodesic_direct(cockpit.position(), geo::Bearing::degrees(60.0), geo::Length::nautical_miles(range_nm));
    cockpit.tick.command.cursor_latitude_deg = cursor.latitude_deg;
    cockpit.tick.command.cursor_longitude_deg = cursor.longitude_deg;
    cockpit.fly(300);
    EXPECT_LT(cockpit.elevation_off(cursor), 0.1) << range_nm;
    cockpit.tick.command.antenna_elevation_deg = 12.0;
    cockpit.fly(100);
    EXPECT_LT(cockpit.elevation_off(cursor), 0.1) << range_nm;
  }
}

}  // namespace
}  // namespace yars::test
