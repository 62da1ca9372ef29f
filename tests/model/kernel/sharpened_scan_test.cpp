// HRM PPI (sector scan with Doppler beam sharpening, DBS): scan time, pointing, SNIFF and freeze, blind zone.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "model/kernel/doppler_modes.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::test {
namespace {

using databuffer::Sweep;

class HrmCockpit : public Cockpit {
 public:
  explicit HrmCockpit(const radar::RadarConfiguration& configuration = {}, double width_deg = 100.0)
      : Cockpit(configuration) {
    tick.command.mode = static_cast<std::uint8_t>(radar::Mode::hrm);
    tick.command.scan_width_deg = width_deg;
  }
};

// Ticks between the first sweeps of two successive scans; 0: no two scans start within 60 s.
std::int64_t ticks_per_scan(Cockpit& cockpit) {
  std::int64_t first = 0;
  for (int i = 0; i < 12'000; ++i) {
    const Sweep* sweep = cockpit.step();
    if (sweep == nullptr || !is_scan_start(*sweep)) continue;
    if (first > 0) return sweep->tick - first;
    first = sweep->tick;
  }
  return 0;
}

TEST(DbsScan, HasTheConfiguredScanTimeInProportionToWidth) {
  const radar::RadarConfiguration configuration;
  const double wanted = configuration.high_resolution.sector_time_s / radar::kTickSeconds;
  HrmCockpit full;
  EXPECT_NEAR(static_cast<double>(ticks_per_scan(full)), wanted, 0.05 * wanted);
  HrmCockpit quarter(configuration, 25.0);
  EXPECT_NEAR(static_cast<double>(ticks_per_scan(quarter)), 0.25 * wanted, 0.05 * wanted);
}

TEST(DbsScan, HasOneBarEvenIfTheRealBeamMapHasFour) {
  radar::RadarConfiguration configuration;
  configuration.antenna.scan_bars = 4;
  HrmCockpit four(configuration);
  HrmCockpit one;
  EXPECT_EQ(ticks_per_scan(four), ticks_per_scan(one));
}

TEST(DbsScan, StopsAtOnceWithSniffAndAtTheEndOfTheScanWithFreeze) {
  for (const bool sniff : {true, false}) {
    HrmCockpit cockpit;
    ASSERT_FALSE(cockpit.run(1000).empty());
    cockpit.set_flag(databuffer::kFreeze, true);
    cockpit.set_flag(databuffer::kSniff, sniff);
    // One sweep that was measured before may still follow.
    const std::size_t sweeps = cockpit.run(400).size();
    if (sniff)
      EXPECT_LE(sweeps, 1U);
    else
      EXPECT_GT(sweeps, 50U);
  }
}

TEST(DbsScan, IsCentredOnTheCursorWithinTheWidestScan) {
  radar::RadarConfiguration configuration;
  configuration.scan_widths_deg = {120.0, 60.0, 20.0};
  HrmCockpit cockpit(configuration, 60.0);
  const geo::GeoPoint position{cockpit.tick.ownship.latitude_deg, cockpit.tick.ownship.longitude_deg};
  const auto offset_of = [&](double off_deg) {
    const geo::GeoPoint cursor =
        geo::geodesic_direct(position, geo::Bearing::degrees(45.0 + off_deg), geo::Length::nautical_miles(20.0));
    databuffer::RadarCommand command = cockpit.tick.command;
    command.flags |= databuffer::kCursorValid;
    command.cursor_latitude_deg = cursor.latitude_deg;
    command.cursor_longitude_deg = cursor.longitude_deg;
    const auto pose = model::kernel::pose_of(cockpit.tick.ownship);
    return model::kernel::dbs_sector(command, *pose, configuration).offset_deg;
  };
  EXPECT_NEAR(offset_of(12.0), 12.0, 0.01);
  EXPECT_NEAR(offset_of(-20.0), -20.0, 0.01);
  EXPECT_NEAR(offset_of(80.0), 30.0, 1e-9);
}

TEST(DbsScan, HasNoVideoInTheBlindZone) {
  HrmCockpit cockpit;
  int blind = 0;
  int lit = 0;
  for (const Sweep& sweep : cockpit.run(4000)) {
    const double off_deg =
        (geo::Bearing::degrees(0.5 * (sweep.azimuth_left_deg + sweep.azimuth_right_deg)) - geo::Bearing::degrees(45.0))
            .degrees();
    double sum = 0.0;
    for (std::uint32_t i = 0; i < sweep.samples; ++i) sum += sweep.video[i];
    if (std::abs(off_deg) < 7.0) {
      EXPECT_EQ(sum, 0.0) << off_deg;
      ++blind;
    } else if (std::abs(off_deg) > 10.0) {
      lit += sum > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(blind, 5);
  EXPECT_GT(lit, 50);
}

}  // namespace
}  // namespace yars::test
