// Test of scans in alternating directions over bright land: there is no black gap between the newest sweep and older
// ones. With YARS_PICTURES=FOLDER in the environment, one of the pictures is written to that folder.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "display/gl/context.hpp"
#include "display/gl/display.hpp"
#include "lib/radar/configuration.hpp"
#include "tests/display/gl/made_up_sweeps.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display::gl {
namespace {

constexpr double kScanTrack_deg = 30.0;
constexpr double kSpeed_mps = 250.0;

struct Scan {
  radar::Mode mode;
  double range_nm;
  double step_deg, step_s;  // azimuth and time from sweep to sweep
  double half_width_deg;
};
constexpr Scan kBeamMap{radar::Mode::rbm, 10.0, 0.55, 0.005, 50.0};
constexpr Scan kShortBeamMap{radar::Mode::rbm, 4.7, 0.55, 0.005, 50.0};
constexpr Scan kHrmPpi{radar::Mode::hrm, 20.0, 0.14, 0.0252, 50.0};

// Picture during a scan to and fro that begins at the left edge. The last of `passes` passes has reached stop_right_deg
// right of the ground track. The aircraft is then at kAircraftPosition.
imageio::Image picture_of(const Scan& scan, int passes, double stop_right_deg, double speed_mps) {
  const int steps = static_cast<int>(2.0 * scan.half_width_deg / scan.step_deg);
  const double from_edge_deg =
      passes % 2 == 1 ? stop_right_deg + scan.half_width_deg : scan.half_width_deg - stop_right_deg;
  const int total = (passes - 1) * steps + static_cast<int>(from_edge_deg / scan.step_deg);
  Display radar_display(radar::RadarConfiguration(), 480);
  for (int i = 0; i < total; ++i) {
    const double behind_nm = (total - 1 - i) * scan.step_s * speed_mps / geo::kMetresPerNauticalMile;
    const bool clockwise = i / steps % 2 == 0;
    const int step = clockwise ? i % steps : steps - 1 - i % steps;
    const double left_deg = kScanTrack_deg - scan.half_width_deg + step * scan.step_deg;
    databuffer::Sweep sweep =
        testing::toned_sweep(testing::at(kScanTrack_deg, -behind_nm), left_deg, left_deg + scan.step_deg,
                             scan.range_nm * geo::kMetresPerNauticalMile, 480, 255);
    sweep.scan = 1U + static_cast<std::uint32_t>(i / steps);
    sweep.mode = static_cast<std::uint8_t>(scan.mode);
    radar_display.add(sweep);
  }
  DisplayInput input = testing::operating(scan.mode, scan.range_nm);
  input.state.brightness = 15;
  radar_display.draw(input);
  return radar_display.read();
}

// Number of pixels in the sector that are lit for a hovering aircraft and dark for a flying one. Pixels near the apex
// do not count: there the display leaves gaps open (PolarStore::kNearFraction).
int dark_pixels(const Scan& scan, int passes, double stop_right_deg) {
  const imageio::Image flying = picture_of(scan, passes, stop_right_deg, kSpeed_mps);
  const imageio::Image hovering = picture_of(scan, passes, stop_right_deg, 0.0);
  // Ground that was beyond the range of the old sweeps does not count. They are at most two passes old.
  const double pass_m = kSpeed_mps * scan.step_s * 2.0 * scan.half_width_deg / scan.step_deg;
  const double far = 398.0 - 400.0 * 2.0 * pass_m / (scan.range_nm * geo::kMetresPerNauticalMile);
  int dark = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 480; ++x) {
      const double right = x + 0.5 - 240.0, up = 440.0 - (y + 0.5);
      const double right_deg = std::atan2(right, up) / geo::kRadiansPerDegree;
      const double range = std::hypot(right, up);
      if (range < 30.0 || range > far || std::abs(right_deg) > scan.half_width_deg - 2.0) continue;
      const std::size_t at = (static_cast<std::size_t>(y) * 480 + static_cast<std::size_t>(x)) * 3 + 1;
      dark += hovering.pixels[at] > 100 && flying.pixels[at] < 30 ? 1 : 0;
    }
  }
  return dark;
}

TEST(ScanEdge, NoBlackGapBetweenTheNewestSweepAndOlderOnes) {
  auto context = open_headless();
  if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
  if (const char* folder = std::getenv("YARS_PICTURES")) {
    const std::string path = std::string(folder) + "/scan_edge.png";
    EXPECT_TRUE(imageio::write_png(path, picture_of(kBeamMap, 3, 30.0, kSpeed_mps))) << path;
  }
  for (const Scan& scan : {kBeamMap, kShortBeamMap, kHrmPpi}) {
    for (const int passes : {3, 4}) {
      for (const double stop_right_deg : {-45.0, 5.0, 48.0}) {
        EXPECT_EQ(dark_pixels(scan, passes, stop_right_deg), 0) << radar::name_of(scan.mode) << " at " << scan.range_nm
                                                                << " NM, pass " << passes << " at " << stop_right_deg;
      }
    }
  }
}

}  // namespace
}  // namespace yars::display::gl
