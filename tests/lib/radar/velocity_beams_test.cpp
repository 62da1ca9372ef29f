// Velocity over ground by least squares from the Doppler speeds of several beams, and its horizontal dilution of
// precision. Frame: north, east, down.
#include "lib/radar/velocity_beams.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/radar/mission.hpp"

namespace yars::radar {
namespace {

using geo::Vector3;

// Unit vectors of the lines of sight. Depressions are positive below the horizon.
std::vector<Vector3> lines_of(const std::vector<double>& azimuths_deg, const std::vector<double>& depressions_deg) {
  std::vector<Vector3> lines;
  for (std::size_t i = 0; i < azimuths_deg.size(); ++i)
    lines.push_back(line_of_sight(geo::Bearing::degrees(azimuths_deg[i]), geo::Angle::degrees(-depressions_deg[i])));
  return lines;
}

TEST(VelocityBeams, ALineOfSightIsNorthEastDown) {
  const Vector3 east_and_down = line_of_sight(geo::Bearing::degrees(90.0), geo::Angle::degrees(-30.0));
  EXPECT_NEAR(east_and_down.x, 0.0, 1e-15);
  EXPECT_NEAR(east_and_down.y, std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(east_and_down.z, 0.5, 1e-15);
}

TEST(VelocityBeams, WithoutNoiseTheSpeedsGiveTheVelocityBack) {
  const Vector3 velocity{170.0, -40.0, 3.0};
  for (const auto& lines : {lines_of({-30, 30, 0}, {15, 15, 45}), lines_of({-30, 30, 30, -30}, {15, 15, 45, 45})}) {
    std::vector<double> speeds;
    for (const Vector3& line : lines) speeds.push_back(dot(line, velocity));
    const auto found = velocity_of(lines, speeds);
    ASSERT_TRUE(found);
    EXPECT_NEAR(length(*found - velocity), 0.0, 1e-10);
  }
}

TEST(VelocityBeams, DifferentNumbersOfLinesAndSpeedsAbort) {
  const auto lines = lines_of({-30, 30, 0}, {15, 15, 45});
  const std::array<double, 2> speeds{100.0, 90.0};
  EXPECT_DEATH(velocity_of(lines, speeds), "3 and 2");
}

TEST(VelocityBeams, TwoParallelBeamsAreAveraged) {
  // Two beams along one line measure 100 m/s with errors of +1 and -1 m/s.
  const std::array<Vector3, 4> lines{Vector3{1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::array<double, 4> speeds{101.0, 99.0, 5.0, -2.0};
  const auto found = velocity_of(lines, speeds);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, 100.0, 1e-12);
  EXPECT_NEAR(found->y, 5.0, 1e-12);
  EXPECT_NEAR(found->z, -2.0, 1e-12);
}

TEST(VelocityBeams, BeamsInOnePlaneMeasureNothing) {
  EXPECT_FALSE(horizontal_dilution(lines_of({-30, 30}, {20, 20})));
  EXPECT_FALSE(horizontal_dilution(lines_of({0, 0, 0}, {10, 30, 50})));
  EXPECT_FALSE(horizontal_dilution(lines_of({20, 20, 20, 20}, {20, 20, 20, 20})));
  EXPECT_TRUE(horizontal_dilution(lines_of({-30, 30, 0}, {20, 20, 45})));
}

TEST(VelocityBeams, DilutionEqualsTheClosedForm) {
  const std::array<Vector3, 3> orthogonal{Vector3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(horizontal_dilution(orthogonal).value_or(0.0), 1.0, 1e-12);
  // The default beams are pairs at azimuths of -30 and +30 degrees, so the normal matrix couples only the components
  // along and down. sin^2 30 deg = 0.25, cos^2 30 deg = 0.75.
  const double low = 15.0 * geo::kRadiansPerDegree, high = 45.0 * geo::kRadiansPerDegree;
  const double across = 2.0 * 0.25 * (std::pow(std::cos(low), 2) + std::pow(std::cos(high), 2));
  const double along = 2.0 * 0.75 * (std::pow(std::cos(low), 2) + std::pow(std::cos(high), 2));
  const double down = 2.0 * (std::pow(std::sin(low), 2) + std::pow(std::sin(high), 2));
  const double along_down = std::sqrt(3.0) * (std::cos(low) * std::sin(low) + std::cos(high) * std::sin(high));
  const double variance_along = down / (along * down - along_down * along_down);
  const NavigationConfiguration beams;
  EXPECT_NEAR(horizontal_dilution(beams.beam_azimuths_deg, beams.beam_depressions_deg).value_or(0.0),
              std::sqrt(0.5 * (variance_along + 1.0 / across)), 1e-9);
}

}  // namespace
}  // namespace yars::radar
