// `yars patch` and `yars scan` beyond the limits of the radar: the error names the limit and the value, and --force
// makes the output nevertheless.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/imageio/png.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr geo::GeoPoint kTarget{37.5, -121.5};

std::string text_of(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.9f", value);
  return text.data();
}

// Runs `yars patch` over the built-in hills. The aircraft flies north; the target lies at a bearing and distance.
endtoend::Finished patch(double bearing_deg, double distance_nm, const std::vector<std::string>& more = {}) {
  const geo::GeoPoint aircraft = geo::geodesic_direct(kTarget, geo::Bearing::degrees(bearing_deg + 180.0),
                                                      geo::Length::nautical_miles(distance_nm));
  // `bearing_deg` is exact at the target. At the aircraft it differs by less than 0.6 degree (meridian convergence).
  std::vector<std::string> command{"yars",         "patch",
                                   "--lat",        text_of(aircraft.latitude_deg),
                                   "--lon",        text_of(aircraft.longitude_deg),
                                   "--target-lat", text_of(kTarget.latitude_deg),
                                   "--target-lon", text_of(kTarget.longitude_deg),
                                   "--size",       "64"};
  command.insert(command.end(), more.begin(), more.end());
  return endtoend::run_program(command);
}

TEST(PatchLimits, EachErrorHasTheLimitTheValueAndForceAsTheRemedy) {
  struct Row {
    double bearing_deg, distance_nm;
    std::vector<std::string> more;
    const char *name, *limit, *found;
  };
  // Source: docs/pilots_manual.md#rule-2, #rule-3, #rule-4.
  const Row rows[] = {
      {2.0, 20.0, {}, "BLIND ZONE", "8 to 172 deg off the ground track", "found one 2."},
      {-7.0, 20.0, {}, "BLIND ZONE", "8 to 172 deg", "found one 7."},
      {178.0, 20.0, {}, "BLIND ZONE", "8 to 172 deg off the ground track", "found one 178"},
      {75.0, 20.0, {}, "GIMBAL", "within 60 deg of the nose", "deg right of it"},
      {-120.0, 20.0, {}, "GIMBAL", "within 60 deg of the nose", "deg left of it"},
      {30.0, 4.0, {}, "MIN RANGE", "4.7 to 80 NM away", "found 4.00 NM"},
      {30.0, 85.0, {}, "MAX RANGE", "4.7 to 80 NM away", "found 85.00 NM"},
      {30.0, 25.0, {"--window-nm", "0.67"}, "MAX RANGE", "for a window of 0.67 NM a target 4.7 to 20 NM", "25.00 NM"},
      {30.0, 16.0, {"--window-nm", "20"}, "MIN RANGE", "20 to 160 NM away", "16.00 NM"},
      {30.0, 20.0, {"--window-nm", "5"}, "NO WINDOW", "0.67, 1.3, 3.3, 4.7, 10, 20, 40, 80 NM", "found 5 NM"},
      {30.0, 5.0, {"--alt-ft", "70000"}, "GIMBAL", "at most 60 deg below the horizon", "deg below it"},
      {30.0, 20.0, {"--alt-ft", "-2000"}, "--alt-ft", "above the ground", "found -2000 ft"}};
  for (const Row& row : rows) {
    const auto run = patch(row.bearing_deg, row.distance_nm, row.more);
    EXPECT_EQ(run.code, 1) << row.bearing_deg << " deg " << row.distance_nm << " NM";
    EXPECT_THAT(run.errors,
                AllOf(HasSubstr(row.name), HasSubstr(row.limit), HasSubstr(row.found), HasSubstr("--force")));
    EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
    EXPECT_EQ(run.output, "");
    std::vector<std::string> forced = row.more;
    forced.emplace_back("--force");
    EXPECT_EQ(patch(row.bearing_deg, row.distance_nm, forced).code, 0) << row.name;
  }
}

// Gimbal and blind zone leave 52, 5.5, 22 and 3 degrees between them.
TEST(PatchLimits, TheHeadingThatTheErrorProposesIsWithinTheLimits) {
  const test::TemporaryFolder folder;
  std::vector<std::vector<std::string>> configurations{{}};
  const auto add = [&](const std::string& gimbal_deg, const std::string& blind_deg) {
    const std::string file = folder.path() / ("gimbal" + gimbal_deg + ".guf");
    std::ofstream(file) << "( Apg70 :antenna ( AntennaServo :azimuthLimits `( -" << gimbal_deg << " " << gimbal_deg
                        << " ) ) :highResolution ( HighResolution :blindZone " << blind_deg
                        << " ) :modes `( ( RealBeamMode :antenna ( RbmAntenna :scanWidths `( 50 40 25 ) ) ) ) )\n";
    configurations.push_back({"--config", file});
  };
  add("50", "44.5");
  add("30", "8");
  add("43", "40");
  for (const auto& configuration : configurations)
    for (const double bearing_deg : {3.0, -5.0, 90.0, -170.0}) {
      const auto refused = patch(bearing_deg, 20.0, configuration);
      ASSERT_EQ(refused.code, 1) << refused.errors;
      const std::size_t at = refused.errors.find("--heading ");
      ASSERT_NE(at, std::string::npos) << refused.errors;
      const std::string heading = refused.errors.substr(at + 10, refused.errors.find(',', at) - at - 10);
      std::vector<std::string> again = configuration;
      again.insert(again.end(), {"--heading", heading});
      const auto accepted = patch(bearing_deg, 20.0, again);
      EXPECT_EQ(accepted.code, 0) << heading << " " << accepted.errors;
    }
}

TEST(PatchLimits, TheDefaultMapIsWithinTheLimits) {
  const auto run = endtoend::run_program({"yars", "patch"});
  EXPECT_EQ(run.code, 0);
  const unsigned processors = std::max(std::thread::hardware_concurrency(), 1U);
  EXPECT_THAT(run.output, HasSubstr(" on " + std::to_string(processors) + " thread"));
}

// A large map is made in sectors; one of 4096 pixels takes 5 s. `reference` holds the whole grid, so it makes smaller
// maps only.
TEST(PatchLimits, MapsHaveUpTo4096Pixels) {
  const auto map = [](const std::string& size, const std::string& preset) {
    return endtoend::run_program({"yars", "patch", "--size", size, "--fidelity", preset});
  };
  const std::string size = std::getenv("YARS_TEST_FULL") != nullptr ? "4096" : "1536";
  const auto large = map(size, "standard");
  EXPECT_EQ(large.code, 0) << large.errors;
  EXPECT_THAT(large.output, HasSubstr(size + " pixels"));
  const auto larger = map("4097", "standard");
  EXPECT_EQ(larger.code, 2);
  EXPECT_EQ(larger.errors,
            "yars patch: --size: expected a whole number from 16 to 4096, found '4097'; see yars patch "
            "--help\n");
  const auto reference = map("1025", "reference");
  EXPECT_EQ(reference.code, 2);
  EXPECT_THAT(reference.errors, HasSubstr("--size: expected at most 1024 with the algorithm reference, found 1025"));
}

// A configuration with other windows and another window at power-up.
TEST(PatchLimits, AreThoseOfTheConfiguration) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path() / "other.guf";
  std::ofstream(file)
      << "( Apg70 :modes `( ( SarMode :windows `( 1 2.5 ) ) ) :windowLimits ( WindowLimits :windows `( 1 2.5 ) "
         ":least `( 5 5 ) :greatest `( 20 40 ) :blankWindows `( 2.5 ) :blankUpTo `( 30 ) :powerUp 2.5 ) )\n";
  const auto usual = patch(30.0, 20.0, {"--config", file, "--json"});
  EXPECT_EQ(usual.code, 0) << usual.errors;
  EXPECT_THAT(usual.output, HasSubstr("\"resolution_ft\":31.6"));  // 2.5 NM / 480 resolution cells, for any --size
  EXPECT_THAT(patch(30.0, 45.0, {"--config", file}).errors, HasSubstr("5 to 40 NM away, found 45.00 NM"));
  EXPECT_THAT(patch(30.0, 20.0, {"--config", file, "--window-nm", "4.7"}).errors, HasSubstr("1, 2.5 NM, found 4.7 NM"));
}

TEST(PatchLimits, BlindAndHiddenPartsOfAMapAreReported) {
  EXPECT_THAT(patch(9.0, 12.0).errors, HasSubstr("% of the map lie in the blind zone and are blank"));
  // From 3000 ft, the horizon is at most 67 NM away.
  EXPECT_THAT(patch(30.0, 79.0, {"--alt-ft", "3000"}).errors,
              HasSubstr("nothing of the map is seen: it lies in shadow or beyond the horizon"));
  EXPECT_EQ(patch(30.0, 20.0).errors, "");
}

TEST(PatchLimits, AForcedMapIsBlankInTheBlindZoneOnly) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path() / "map.f32";
  // The target is 12 NM away and 7 degrees off the track. The edge of the blind zone, 8 degrees, crosses the window.
  ASSERT_EQ(patch(7.0, 12.0, {"--force", "--out", file}).code, 0);
  std::ifstream in(file, std::ios::binary);
  std::vector<float> power(64U * 64U);
  in.read(reinterpret_cast<char*>(power.data()), static_cast<std::streamsize>(power.size() * sizeof(float)));
  ASSERT_TRUE(in);
  const auto blank = std::count_if(power.begin(), power.end(), [](float value) { return value < 0.0F; });
  const auto ground = std::count_if(power.begin(), power.end(), [](float value) { return value > 0.0F; });
  EXPECT_GT(blank, 1000);
  EXPECT_GT(ground, 400);
}

// The limits come from the configuration file that the test writes.
TEST(ScanLimits, AreTheGimbalOfTheConfigurationAndTheGround) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path() / "narrow.guf";
  std::ofstream(file) << "( Apg70 :antenna ( AntennaServo :azimuthLimits `( -40 40 ) :elevationLimits `( -30 30 ) ) "
                         ":modes `( ( RealBeamMode :antenna ( RbmAntenna :scanWidths `( 80 50 25 ) ) ) ) )\n";
  struct Row {
    std::vector<std::string> options;
    const char* message;
  };
  const Row rows[] = {
      {{"--scan-width", "50", "--elevation", "-31"},
       "--elevation: expected -30 to 30 deg, the configured gimbal limits, found -31 deg"},
      {{"--scan-width", "100"}, "--scan-width: expected 0 to 80 deg, the configured gimbal limits, found 100 deg"},
      {{"--scan-width", "50", "--alt-ft", "-2000"}, "--alt-ft: expected an aircraft above the ground, which is at "}};
  for (const Row& row : rows) {
    std::vector<std::string> command{"yars", "scan", "--config", file, "--samples", "60", "--range-nm", "10"};
    command.insert(command.end(), row.options.begin(), row.options.end());
    const auto run = endtoend::run_program(command);
    EXPECT_EQ(run.code, 1) << run.output;
    EXPECT_THAT(run.errors, HasSubstr(row.message));
    command.emplace_back("--force");
    EXPECT_EQ(endtoend::run_program(command).code, 0) << row.message;
  }
}

}  // namespace
}  // namespace yars
