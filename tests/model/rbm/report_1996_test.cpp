// Real beam map of the preset `1996`. Source: docs/spec/physics.md#preset-1996.
#include "model/rbm/report_1996.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

constexpr double kReportAltitude_m = 2000.0;
constexpr double kReportRange_m = 40000.0;
constexpr std::size_t kReportSamples = 1000;
constexpr double kReportSpacing_m = kReportRange_m / kReportSamples;

// Intensity of full scale: level ground at half the range.
const double kFullScale = kReportAltitude_m / std::hypot(kReportAltitude_m, 0.5 * kReportRange_m);

// Intensity by sample, as a fraction of full scale. `bars_deg`: angle of the scan's bars above and below the beam.
std::vector<float> intensity(const terrain::AnalyticTerrain::Height& height, double elevation_deg,
                             double bars_deg = 0.0) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = static_cast<int>(kReportSamples);
  Report1996 report(configuration);
  physics::SweepGeometry geometry = test::geometry_north(kReportAltitude_m, kReportRange_m);
  geometry.elevation = geo::Angle::degrees(elevation_deg);
  geometry.bars_above = geometry.bars_below = geo::Angle::degrees(bars_deg);
  std::vector<float> power(kReportSamples);
  report.measure(geometry, terrain::AnalyticTerrain(height), power);
  return power;
}

std::size_t sample_at(double distance_m) {
  return static_cast<std::size_t>(distance_m / kReportSpacing_m);
}

TEST(Report1996, AFlatPlaneReturnsTheSineOfItsDepressionOnlyWithinTheBeam) {
  const auto power = intensity(terrain::flat(0.0), -5.0);
  for (std::size_t i = 1; i + 1 < kReportSamples; ++i) {
    const double distance_m = (static_cast<double>(i) + 0.5) * kReportSpacing_m;
    const double depression_deg = std::atan(kReportAltitude_m / distance_m) / geo::kRadiansPerDegree;
    const double sine = kReportAltitude_m / std::hypot(kReportAltitude_m, distance_m);
    if (std::abs(depression_deg - 5.0) < 1.2) {
      EXPECT_NEAR(static_cast<double>(power[i]), sine / kFullScale, 1e-3 / kFullScale) << distance_m;
    }
    if (std::abs(depression_deg - 5.0) > 1.3) {
      EXPECT_EQ(power[i], 0.0F) << distance_m;
    }
  }
}

TEST(Report1996, LevelGroundAtFullRangeIsHalfAsBrightAsAtHalfRange) {
  const auto power = intensity(terrain::flat(0.0), -4.0, 2.0);
  EXPECT_NEAR(static_cast<double>(power[kReportSamples / 2]), 1.0, 0.01);
  EXPECT_NEAR(static_cast<double>(power[kReportSamples - 2]), 0.5, 0.01);
}

// Each bar shows the ground within the beams of all bars.
TEST(Report1996, EveryBarOfAScanMakesTheSamePicture) {
  const auto hills = [](geo::GeoPoint position) { return 400.0 + 400.0 * std::sin(position.latitude_deg * 300.0); };
  std::vector<std::vector<float>> bars;
  constexpr double kBeam_deg = 2.5;
  for (int bar = 0; bar < 4; ++bar) {
    radar::RadarConfiguration configuration;
    configuration.fidelity.samples = static_cast<int>(kReportSamples);
    Report1996 report(configuration);
    physics::SweepGeometry geometry = test::geometry_north(kReportAltitude_m, kReportRange_m);
    geometry.elevation = geo::Angle::degrees(-5.0 + kBeam_deg * (1.5 - bar));
    geometry.bars_above = geo::Angle::degrees(kBeam_deg * bar);
    geometry.bars_below = geo::Angle::degrees(kBeam_deg * (3 - bar));
    bars.emplace_back(kReportSamples);
    report.measure(geometry, terrain::AnalyticTerrain(hills), bars.back());
  }
  std::size_t lit = 0;
  for (std::size_t i = 0; i < kReportSamples; ++i) {
    lit += bars[0][i] > 0.0F ? 1U : 0U;
    for (int bar = 1; bar < 4; ++bar) EXPECT_NEAR(bars[static_cast<std::size_t>(bar)][i], bars[0][i], 1e-4F) << i;
  }
  EXPECT_GT(lit, kReportSamples / 10);
}

TEST(Report1996, GroundAboveFullScaleIsClippedBeforeTheGain) {
  Report1996 report{radar::RadarConfiguration{}};
  const std::vector<float> power(4, 3.0F);
  std::vector<std::uint8_t> video(4);
  for (int gain = 0; gain <= 3; ++gain) {
    report.form_video({power, power, power}, geo::Length::metres(kReportRange_m), gain, {}, video);
    EXPECT_NEAR(video[1], 255.0 * (gain + 1) / 4.0, 0.51);
  }
}

TEST(Report1996, AMastAboveTheBeamCastsNoShadow) {
  // The preset keeps this error of the report. The algorithm `reference` casts the shadow:
  // Reference.ARidgeAboveTheBeamStillCastsItsShadow.
  const auto power = intensity(
      [](geo::GeoPoint position) {
        const double distance_m = geo::geodesic_inverse(test::kMidLatitude, position).distance.metres();
        return std::abs(distance_m - 10020.0) < 0.5 * kReportSpacing_m ? 1800.0 : 0.0;
      },
      -5.71);
  EXPECT_GT(power[sample_at(20000.0)], 0.0F);
}

TEST(Report1996, ARidgeInTheBeamCastsItsShadow) {
  const auto power = intensity(terrain::ridge(test::axis_north(), 18000.0, 1000.0, 300.0), -5.71);
  EXPECT_EQ(power[sample_at(19500.0)], 0.0F);
  EXPECT_GT(power[sample_at(22000.0)], 0.0F);
}

TEST(Report1996, GainHasStepsOfAQuarter) {
  Report1996 report{radar::RadarConfiguration{}};
  const std::vector<float> power(4, 0.8F);
  std::vector<std::uint8_t> video(4);
  for (int gain = 0; gain <= 3; ++gain) {
    report.form_video({power, power, power}, geo::Length::metres(kReportRange_m), gain, {}, video);
    EXPECT_NEAR(video[1], 255.0 * 0.8 * (gain + 1) / 4.0, 0.51);
  }
}

TEST(Report1996, ThreeSweepsAreWeightedQuarterHalfQuarter) {
  Report1996 report{radar::RadarConfiguration{}};
  const std::vector<float> bright(4, 1.0F), dark(4, 0.0F);
  std::vector<std::uint8_t> video(4);
  report.form_video({bright, dark, dark}, geo::Length::metres(kReportRange_m), 3, {}, video);
  EXPECT_EQ(video[0], 64);
  report.form_video({dark, bright, dark}, geo::Length::metres(kReportRange_m), 3, {}, video);
  EXPECT_EQ(video[0], 128);
}

}  // namespace
}  // namespace yars::model::rbm
