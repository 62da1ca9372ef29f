// RadarKernel: reaction to commands (power, freeze, SNIFF, restart) and epochs, the terrain that it needs, its status.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>

#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::model::kernel {
namespace {

using databuffer::Sweep;
using test::Cockpit;
using test::is_scan_end;
using test::is_scan_start;

double mean_video(const Sweep& sweep) {
  return std::accumulate(sweep.video, sweep.video + sweep.samples, 0.0) / sweep.samples;
}

TEST(RadarKernel, AFullScanMakes182SweepsInOneSecond) {
  Cockpit cockpit;
  ASSERT_TRUE(cockpit.run_until(is_scan_end));
  for (int scan = 0; scan < 5; ++scan) {
    const auto sweeps = cockpit.run(200);
    ASSERT_EQ(sweeps.size(), 182U);
    EXPECT_TRUE(is_scan_start(sweeps.front()));
    EXPECT_TRUE(is_scan_end(sweeps.back()));
    EXPECT_EQ(sweeps.front().scan, sweeps.back().scan);
    EXPECT_EQ(sweeps.back().number - sweeps.front().number, 181U);
  }
}

TEST(RadarKernel, SweepsOfAScanLeaveNoGaps) {
  Cockpit cockpit;
  const auto sweeps = cockpit.run(1000);
  for (std::size_t i = 1; i < sweeps.size(); ++i) {
    if (sweeps[i].scan != sweeps[i - 1].scan) continue;
    const bool clockwise = sweeps[i].direction == 1;
    ASSERT_EQ(clockwise ? sweeps[i].azimuth_left_deg : sweeps[i].azimuth_right_deg,
              clockwise ? sweeps[i - 1].azimuth_right_deg : sweeps[i - 1].azimuth_left_deg);
  }
}

TEST(RadarKernel, MakesNoSweepsInOffAndStandby) {
  for (const auto power : {radar::Power::off, radar::Power::standby}) {
    Cockpit cockpit;
    cockpit.run(300);
    cockpit.tick.command.power = static_cast<std::uint8_t>(power);
    EXPECT_TRUE(cockpit.run(300).empty());
    EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground);
    EXPECT_EQ(cockpit.status().flags & databuffer::kModelScanning, 0U);
  }
}

TEST(RadarKernel, ScansInBeaconModeWithoutGroundVideo) {
  Cockpit cockpit;
  const double lit = mean_video(cockpit.run(400).back());
  cockpit.tick.command.mode = static_cast<std::uint8_t>(radar::Mode::beacon);
  ++cockpit.tick.command.scan_restart;
  const auto sweeps = cockpit.run(400);
  ASSERT_GT(sweeps.size(), 300U);
  // Only receiver noise remains, which is darker than black.
  EXPECT_LT(mean_video(sweeps.back()), 0.5 * lit);
  EXPECT_EQ(sweeps.back().mode, cockpit.tick.command.mode);
  EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground) << "no beacon that the terrain could hide";
}

TEST(RadarKernel, FreezeStopsAtTheEndOfTheScan) {
  Cockpit cockpit;
  ASSERT_TRUE(cockpit.run_until(is_scan_start));
  cockpit.run(20);
  cockpit.set_flag(databuffer::kFreeze, true);
  const auto rest = cockpit.run(400);
  EXPECT_EQ(rest.size(), 182U - 21U);
  EXPECT_TRUE(is_scan_end(rest.back()));
  EXPECT_NE(cockpit.status().flags & databuffer::kModelFrozen, 0U);
  EXPECT_EQ(cockpit.status().flags & databuffer::kModelScanning, 0U);
  EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground);
}

TEST(RadarKernel, UnfreezeStartsTheNextScan) {
  Cockpit cockpit;
  cockpit.set_flag(databuffer::kFreeze, false);
  const auto before = cockpit.run_until(is_scan_end);
  cockpit.set_flag(databuffer::kFreeze, true);
  cockpit.run(400);
  cockpit.set_flag(databuffer::kFreeze, false);
  EXPECT_TRUE(cockpit.kernel.need(cockpit.tick).ground);
  const auto after = cockpit.run_until(is_scan_start);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->scan, before->scan + 1);
}

TEST(RadarKernel, SniffStopsTransmittingAtTheEndOfTheScan) {
  Cockpit cockpit;
  ASSERT_TRUE(cockpit.run_until(is_scan_start));
  cockpit.set_flag(databuffer::kSniff, true);
  double lit = 0.0;
  const auto last = cockpit.run_until([&](const Sweep& sweep) {
    EXPECT_EQ(sweep.flags & databuffer::kSweepNoiseOnly, 0U);
    lit = mean_video(sweep);
    return is_scan_end(sweep);
  });
  ASSERT_TRUE(last);
  const auto quiet = cockpit.run(200);
  ASSERT_FALSE(quiet.empty());
  for (const Sweep& sweep : quiet) {
    EXPECT_NE(sweep.flags & databuffer::kSweepNoiseOnly, 0U);
    EXPECT_LT(mean_video(sweep), 0.5 * lit);
  }
  EXPECT_NE(quiet[0].hash, quiet[1].hash);
}

TEST(RadarKernel, SniffWithoutJammersNeedsNoTerrainOnceTheScanHasEnded) {
  Cockpit cockpit;
  ASSERT_TRUE(cockpit.run_until(is_scan_start));
  cockpit.set_flag(databuffer::kSniff, true);
  EXPECT_TRUE(cockpit.kernel.need(cockpit.tick).ground) << "the current scan still transmits";
  cockpit.run(400);
  EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground);
  cockpit.set_flag(databuffer::kSniff, false);
  EXPECT_TRUE(cockpit.kernel.need(cockpit.tick).ground);
}

TEST(RadarKernel, SniffNeedsTheTerrainThatMayHideAJammer) {
  radar::RadarConfiguration configuration;
  configuration.world.jamming.jammers.emplace_back();
  Cockpit cockpit(configuration);
  cockpit.set_flag(databuffer::kSniff, true);
  cockpit.run(400);
  EXPECT_TRUE(cockpit.kernel.need(cockpit.tick).ground);
}

TEST(RadarKernel, ARestartBeginsANewScanAtOnce) {
  Cockpit cockpit;
  const auto first = cockpit.run_until(is_scan_start);
  cockpit.run(30);
  ++cockpit.tick.command.scan_restart;
  cockpit.tick.command.scan_width_deg = 50.0;
  const auto second = cockpit.run_until([](const Sweep&) { return true; });
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(is_scan_start(*second));
  EXPECT_EQ(second->scan, first->scan + 1);
  EXPECT_EQ(cockpit.status().scan_restart, 1U);
  EXPECT_EQ(cockpit.run(99).size(), 90U);
}

TEST(RadarKernel, AnEpochBeginsANewScan) {
  Cockpit cockpit;
  const auto first = cockpit.run_until(is_scan_start);
  cockpit.run(30);
  cockpit.tick.epoch = 2;
  cockpit.tick.ownship.latitude_deg = -33.0;
  const auto second = cockpit.run_until([](const Sweep&) { return true; });
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(is_scan_start(*second));
  EXPECT_EQ(second->epoch, 2U);
  EXPECT_EQ(second->apex_latitude_deg, -33.0);
}

TEST(RadarKernel, ASweepHasThePositionAtWhichItWasMeasured) {
  Cockpit cockpit;
  ASSERT_TRUE(cockpit.run_until(is_scan_start));
  for (int i = 0; i < 50; ++i) {
    const double before_deg = cockpit.tick.ownship.latitude_deg;
    const std::int64_t tick = cockpit.tick.tick;
    cockpit.tick.ownship.latitude_deg += 1e-5;
    const Sweep* sweep = cockpit.step();
    ASSERT_NE(sweep, nullptr);
    EXPECT_EQ(sweep->tick, tick);
    EXPECT_EQ(sweep->apex_latitude_deg, before_deg);
  }
}

TEST(RadarKernel, APositionOfNaNMakesABlankSweep) {
  Cockpit cockpit;
  ASSERT_TRUE(cockpit.run_until(is_scan_start));
  cockpit.tick.ownship.latitude_deg = std::nan("");
  cockpit.step();
  cockpit.tick.ownship.latitude_deg = 37.0;
  const Sweep* sweep = cockpit.step();
  ASSERT_NE(sweep, nullptr);
  EXPECT_NE(sweep->flags & databuffer::kSweepBlank, 0U);
  EXPECT_EQ(mean_video(*sweep), 0.0);
  EXPECT_EQ(sweep->apex_latitude_deg, 37.0);
}

TEST(RadarKernel, WaitsForItsFirstPosition) {
  Cockpit cockpit;
  cockpit.tick.flags = 0;
  EXPECT_TRUE(cockpit.run(400).empty());
  const auto status = cockpit.status();
  EXPECT_NE(status.flags & databuffer::kModelStale, 0U);
  EXPECT_EQ(status.mappable, 0);
  EXPECT_STREQ(status.why_not, "NO POSITION");
}

TEST(RadarKernel, SurvivesTicksOfRandomBytes) {
  constexpr unsigned kSeed = 20240611;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  Cockpit cockpit;
  const databuffer::ModelTick good = cockpit.tick;
  for (int round = 0; round < 3000; ++round) {
    cockpit.tick = good;
    // A few random bytes anywhere in the tick; samples stay small so that the test stays fast.
    auto* bytes = reinterpret_cast<unsigned char*>(&cockpit.tick);
    for (int i = 0; i < 3; ++i) bytes[random() % sizeof cockpit.tick] = static_cast<unsigned char>(random());
    cockpit.tick.samples %= 513;
    cockpit.tick.tick = round;
    if (const Sweep* sweep = cockpit.step()) {
      ASSERT_LE(sweep->samples, static_cast<std::uint32_t>(radar::kMaxSamples));
      ASSERT_TRUE(std::isfinite(sweep->azimuth_left_deg) && std::isfinite(sweep->apex_latitude_deg));
    }
    (void)cockpit.status();
  }
}

TEST(RadarKernel, ResumesFromItsStatusWithTheNextSweep) {
  Cockpit first({}, terrain::built_in_hills());
  first.run(700);
  Cockpit second({}, terrain::built_in_hills());
  second.kernel.resume(first.status());
  second.tick = first.tick;
  auto expected = first.run(500);
  auto resumed = second.run(500);
  // The first resumed sweep lacks earlier sweeps for the azimuth smear. All later sweeps are bit-identical.
  const auto from = std::find_if(expected.begin(), expected.end(),
                                 [&](const Sweep& sweep) { return sweep.number == resumed[1].number; });
  ASSERT_NE(from, expected.end());
  for (std::size_t i = 1; i < resumed.size(); ++i) {
    const Sweep& expected_sweep = *(from + static_cast<std::ptrdiff_t>(i) - 1);
    ASSERT_EQ(resumed[i].hash, expected_sweep.hash) << i;
    ASSERT_EQ(resumed[i].scan, expected_sweep.scan);
  }
}

TEST(RadarKernel, ResumesFrozenFromTheStatusOfAFrozenRadar) {
  Cockpit first;
  first.run(300);
  first.set_flag(databuffer::kFreeze, true);
  first.run(400);
  Cockpit second;
  second.kernel.resume(first.status());
  second.tick = first.tick;
  EXPECT_TRUE(second.run(400).empty());
  EXPECT_EQ(second.status().scan, first.status().scan);
}

TEST(RadarKernel, ReportsTheGroundBelowAircraftAndCursor) {
  Cockpit cockpit({}, [](geo::GeoPoint position) { return position.latitude_deg > 37.2 ? 250.0 : 100.0; });
  cockpit.run(10);
  const auto status = cockpit.status();
  EXPECT_DOUBLE_EQ(status.ground_elevation_m, 100.0);
  EXPECT_DOUBLE_EQ(status.cursor_ground_elevation_m, 250.0);
  EXPECT_DOUBLE_EQ(status.height_above_ground_m, 4472.0);
}

TEST(RadarKernel, ReportsTheFormationTimeOfAMapAtTheCursor) {
  Cockpit cockpit;
  cockpit.tick.command.window_nm = 4.7;
  cockpit.run(10);
  const auto status = cockpit.status();
  ASSERT_EQ(status.mappable, 1) << status.why_not;
  EXPECT_GT(status.map_timer_s, 0.1);
  cockpit.tick.command.window_nm = 0.0;
  cockpit.run(10);
  EXPECT_TRUE(std::isnan(cockpit.status().map_timer_s));
}

TEST(RadarKernel, ReportsTheCommandedElevationAfterSlewing) {
  Cockpit cockpit;
  cockpit.run(300);
  EXPECT_NEAR(cockpit.status().antenna_elevation_deg, -4.0, 0.1);
  EXPECT_LE(std::abs(cockpit.status().antenna_azimuth_deg), 60.0);
}

TEST(RadarKernel, NeedsTerrainAsFarAsItsRange) {
  Cockpit cockpit;
  const auto need = cockpit.kernel.need(cockpit.tick);
  ASSERT_TRUE(need.ground);
  EXPECT_EQ(need.region.centre.latitude_deg, 37.0);
  EXPECT_GE(need.region.radius_m, 40.0 * geo::kMetresPerNauticalMile);
}

// Without a valid ownship the record of a tick is all zero, a position in the Gulf of Guinea.
TEST(RadarKernel, NeedsNoTerrainBeforeTheFirstOwnship) {
  Cockpit cockpit;
  const databuffer::Ownship flown = cockpit.tick.ownship;
  cockpit.tick.ownship = {};
  cockpit.tick.flags = 0;
  EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground);
  cockpit.run(10);
  EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground);
  cockpit.tick.ownship = flown;
  cockpit.tick.flags = databuffer::kTickOwnshipValid;
  EXPECT_TRUE(cockpit.kernel.need(cockpit.tick).ground);
  cockpit.run(10);
  cockpit.tick.flags = 0;
  ASSERT_TRUE(cockpit.kernel.need(cockpit.tick).ground) << "the last position stays in use";
  EXPECT_EQ(cockpit.kernel.need(cockpit.tick).region.centre.latitude_deg, 37.0);
}

TEST(RadarKernel, SaysWhyNothingCanBeMappedAtTheCursor) {
  struct Row {
    double bearing_deg, range_nm, window_nm;
    const char* why;
  };
  // The track is 45 degrees. Source: docs/pilots_manual.md#rule-3, #rule-4.
  const Row rows[] = {{50.0, 20.0, 4.7, "BLIND ZONE"},
                      {120.0, 20.0, 4.7, "GIMBAL"},
                      {80.0, 3.0, 4.7, "MIN RANGE"},
                      {80.0, 85.0, 4.7, "MAX RANGE"},
                      {80.0, 155.0, 0.0, "NO WINDOW"},
                      {80.0, 20.0, 4.7, ""},
                      {80.0, 3.0, 0.0, ""}};
  for (const Row& row : rows) {
    Cockpit cockpit;
    const geo::GeoPoint cursor = geo::geodesic_direct({37.0, -122.0}, geo::Bearing::degrees(row.bearing_deg),
                                                      geo::Length::nautical_miles(row.range_nm));
    cockpit.tick.command.cursor_latitude_deg = cursor.latitude_deg;
    cockpit.tick.command.cursor_longitude_deg = cursor.longitude_deg;
    cockpit.tick.command.window_nm = row.window_nm;
    cockpit.run(3);
    EXPECT_STREQ(cockpit.status().why_not, row.why) << row.bearing_deg << " deg " << row.range_nm << " NM";
    EXPECT_EQ(cockpit.status().mappable, row.why[0] == '\0' ? 1 : 0);
  }
}

// Hills with a terrain detail of 9, which no scan in these tests requests.
class ForeignTerrain : public terrain::TerrainView {
 public:
  std::uint64_t generation() const override { return hills_.generation(); }
  std::uint64_t resident_bytes() const override { return hills_.resident_bytes(); }
  terrain::Surface surface_at(geo::GeoPoint position, Interpolation interpolation) const override {
    return hills_.surface_at(position, interpolation);
  }
  bool has_detail(int detail) const override { return detail == 9; }
  std::size_t surfaces(const terrain::PositionRun& positions, Interpolation interpolation,
                       const terrain::SurfaceRun& found) const override {
    return hills_.surfaces(positions, interpolation, found);
  }

 private:
  terrain::AnalyticTerrain hills_{terrain::built_in_hills()};
};

// Flags of the sweeps of 2 s over `view` instead of the cockpit's terrain.
std::vector<std::uint32_t> flags_over(const terrain::TerrainView& view, test::Cockpit& cockpit) {
  std::vector<std::uint32_t> flags;
  for (int i = 0; i < 400; ++i) {
    ++cockpit.tick.tick;
    cockpit.tick.sim_time_ns = cockpit.tick.tick * radar::kTickNanoseconds;
    if (cockpit.kernel.step(cockpit.tick, view, cockpit.sweep)) flags.push_back(cockpit.sweep.flags);
  }
  EXPECT_GT(flags.size(), 100U);
  return flags;
}

TEST(RadarKernel, ASweepOverTerrainOfAnotherDetailIsNotReady) {
  test::Cockpit cockpit;
  const ForeignTerrain foreign;
  EXPECT_NE(cockpit.kernel.need(cockpit.tick).region.detail, 9);
  for (const std::uint32_t flags : flags_over(foreign, cockpit)) EXPECT_NE(flags & databuffer::kSweepNotReady, 0U);
}

TEST(RadarKernel, SniffWithoutJammersIsReadyOverTerrainOfAnotherDetail) {
  Cockpit cockpit;
  const ForeignTerrain foreign;
  cockpit.set_flag(databuffer::kSniff, true);
  for (const std::uint32_t flags : flags_over(foreign, cockpit)) EXPECT_EQ(flags & databuffer::kSweepNotReady, 0U);
}

}  // namespace
}  // namespace yars::model::kernel
