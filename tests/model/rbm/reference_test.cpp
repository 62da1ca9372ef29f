// The algorithm `reference` over ground whose radar picture has a closed form, on a flat earth. With a sensitivity time
// control of (R/R0)^3, the power of pulse-limited land is the tangent of its grazing angle plus its slope.
#include "model/rbm/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/physics/clutter.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

using test::axis_north;
using test::bare_configuration;
using test::geometry_north;
using test::seen_by_reference;

constexpr double kAltitude_m = 2000.0;
constexpr double kRange_m = 40000.0;
constexpr int kSamples = 1000;
constexpr double kSpacing_m = kRange_m / kSamples;

// Distance at which the shadow of a top ends on flat ground at 0 m.
double shadow_end_m(double top_distance_m, double height_m) {
  return top_distance_m * kAltitude_m / (kAltitude_m - height_m);
}

auto seen(const terrain::AnalyticTerrain::Height& height) {
  return seen_by_reference(bare_configuration(kSamples), geometry_north(kAltitude_m, kRange_m),
                           terrain::AnalyticTerrain(height));
}

// Expects dark ground between two distances and lit ground behind them, within one sample.
template <class Samples>
void expect_shadow(const Samples& samples, double from_m, double to_m) {
  for (const auto& sample : samples) {
    if (sample.distance_m > from_m + kSpacing_m && sample.distance_m < to_m - kSpacing_m) {
      EXPECT_FALSE(sample.lit) << sample.distance_m;
      EXPECT_EQ(sample.power, 0.0) << sample.distance_m;
    }
    if (sample.distance_m > to_m + kSpacing_m) {
      EXPECT_TRUE(sample.lit) << sample.distance_m;
      EXPECT_GT(sample.power, 0.0) << sample.distance_m;
    }
  }
}

TEST(Reference, AFlatPlaneReturnsTheTangentOfItsGrazingAngle) {
  for (const auto& sample : seen(terrain::flat(100.0))) {
    if (sample.distance_m < 5000.0) continue;  // nearer, the cell is limited by the beam
    EXPECT_NEAR(sample.power, (kAltitude_m - 100.0) / sample.distance_m, 1e-4 * sample.power) << sample.distance_m;
  }
}

TEST(Reference, AWedgeReturnsTheTangentOfItsGrazingAnglePlusItsSlope) {
  const double slope = 0.05;
  for (const auto& sample : seen(terrain::wedge(axis_north(), 20000.0, slope))) {
    if (sample.distance_m < 20000.0 + 2.0 * kSpacing_m) continue;
    const double height_m = slope * (sample.distance_m - 20000.0);
    const double expected = (kAltitude_m - height_m) / sample.distance_m + slope;
    EXPECT_NEAR(sample.power, expected, 1e-3 * sample.power) << sample.distance_m;
  }
}

TEST(Reference, APlateauCastsAShadowBehindItsFarEdge) {
  const auto samples = seen(terrain::plateau(axis_north(), 15000.0, 18000.0, 500.0));
  expect_shadow(samples, 18000.0, shadow_end_m(18000.0, 500.0));
  for (const auto& sample : samples) {
    if (sample.distance_m < 18000.0 - kSpacing_m) {
      EXPECT_TRUE(sample.lit) << sample.distance_m;
    }
  }
}

TEST(Reference, ASinglePostCastsAShadowOfItsHeightOverTheTangent) {
  const double post_m = 250.5 * kSpacing_m;  // the middle of sample 250
  const auto samples = seen([post_m](geo::GeoPoint position) {
    const double distance_m = geo::geodesic_inverse(test::kMidLatitude, position).distance.metres();
    return std::abs(distance_m - post_m) < 0.5 * kSpacing_m ? 400.0 : 10.0;
  });
  // Heights are relative to the surrounding ground at 10 m.
  const double end_m = post_m * (kAltitude_m - 10.0) / (kAltitude_m - 400.0);
  expect_shadow(samples, post_m, end_m);
  EXPECT_TRUE(samples[250].lit);
}

TEST(Reference, AStepUpIsBrightAndAStepDownCastsAShadow) {
  const auto up = seen(terrain::step_wall(axis_north(), 20000.0, 50.0, 350.0));
  // Searched from 5 km on, because the ground below the aircraft is bright too.
  const auto brightest = std::max_element(up.begin() + static_cast<std::ptrdiff_t>(5000.0 / kSpacing_m), up.end(),
                                          [](const auto& a, const auto& b) { return a.power < b.power; });
  EXPECT_NEAR(brightest->distance_m, 20000.0, kSpacing_m);
  for (const auto& sample : up) EXPECT_TRUE(sample.lit) << sample.distance_m;

  const auto down = seen(terrain::step_wall(axis_north(), 20000.0, 350.0, 50.0));
  const double end_m = 20000.0 * (kAltitude_m - 50.0) / (kAltitude_m - 350.0);
  expect_shadow(down, 20000.0, end_m);
}

TEST(Reference, ARidgeAboveTheBeamStillCastsItsShadow) {
  radar::RadarConfiguration configuration = bare_configuration(kSamples);
  configuration.antenna.elevation_beamwidth_deg = 2.5;
  physics::SweepGeometry geometry = geometry_north(kAltitude_m, kRange_m);
  // The beam points at the ground 20 km away, 5.7 degrees down; the ridge's crest is 1.1 degrees down, above it.
  geometry.elevation = geo::Angle::degrees(-5.71);
  const terrain::AnalyticTerrain ridge(terrain::ridge(axis_north(), 10000.0, 1000.0, 1800.0));
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  const auto at_20_km = [](const auto& samples) { return samples[static_cast<std::size_t>(20000.0 / kSpacing_m)]; };
  EXPECT_GT(at_20_km(seen_by_reference(configuration, geometry, sea)).power, 0.0);
  EXPECT_EQ(at_20_km(seen_by_reference(configuration, geometry, ridge)).power, 0.0);
}

TEST(Reference, AVoidReturnsNothingAndHidesNothing) {
  const auto samples = seen([](geo::GeoPoint position) {
    const double distance_m = geo::geodesic_inverse(test::kMidLatitude, position).distance.metres();
    return distance_m > 10000.0 && distance_m < 11000.0 ? std::numeric_limits<double>::quiet_NaN() : 20.0;
  });
  for (const auto& sample : samples) {
    const bool in_void = std::isnan(sample.height_m);
    EXPECT_EQ(sample.lit, !in_void) << sample.distance_m;
    EXPECT_EQ(sample.power > 0.0, !in_void) << sample.distance_m;
  }
}

TEST(Reference, WaterReturnsByTheSeaModelAndLandByItsGamma) {
  const auto sea = seen(terrain::flat(0.0));
  const auto land = seen(terrain::flat(0.001));
  const radar::RadarConfiguration configuration = bare_configuration(kSamples);
  const double sine = kAltitude_m / std::hypot(kAltitude_m, sea[500].distance_m);
  const double sea_sigma0 =
      physics::sea_sigma0(physics::make_sea_return(configuration), sine, geo::Bearing::degrees(0.0));
  const double land_sigma0 = physics::make_land_return(configuration).gamma[0] * sine;
  EXPECT_NEAR(10.0 * std::log10(sea[500].power / land[500].power), 10.0 * std::log10(sea_sigma0 / land_sigma0), 0.01);
}

// Area normal to the ray is all that returns, so ground that is tilted across the ray returns as level ground.
TEST(Reference, ASlopeAcrossTheSweepReturnsAsLevelGround) {
  const terrain::TerrainAxis east{test::kMidLatitude, geo::Bearing::degrees(90.0)};
  EXPECT_NEAR(seen(terrain::plane(east, 100.0, 0.3))[500].power / seen(terrain::flat(100.0))[500].power, 1.0, 1e-3);
}

TEST(Reference, SmearsConservePower) {
  radar::RadarConfiguration configuration = bare_configuration(kSamples);
  const terrain::AnalyticTerrain ridge(terrain::ridge(axis_north(), 20000.0, 1500.0, 700.0));
  const physics::SweepGeometry geometry = geometry_north(kAltitude_m, kRange_m);
  const auto total = [&](bool smear) {
    configuration.fidelity.pulse_smear = smear;
    Reference reference(configuration);
    std::vector<float> power(kSamples);
    reference.measure(geometry, ridge, power);
    double sum = 0.0;
    // At the ends of the sweep, the smear moves power out of the sweep.
    for (std::size_t i = 300; i < 700; ++i) sum += static_cast<double>(power[i]);
    return sum;
  };
  EXPECT_NEAR(total(true) / total(false), 1.0, 1e-3);
}

TEST(Reference, UniformClutterFluctuatesAsTheMeanOfItsLooks) {
  radar::RadarConfiguration configuration = bare_configuration(4096);
  configuration.fidelity.noise = true;
  configuration.receiver.dynamic_range_db = 60.0;
  configuration.receiver.noise_floor_db = -60.0;
  configuration.receiver.stc_exponent = 0.0;
  // Standard deviations in decibels: docs/spec/physics.md#speckle.
  struct Row {
    int looks;
    double deviation_db;
  };
  for (const Row row : {Row{1, 5.57}, Row{2, 3.49}, Row{4, 2.31}, Row{8, 1.58}, Row{16, 1.10}}) {
    Reference reference(configuration);
    const std::vector<float> power(4096, 1e-2F);
    std::vector<std::uint8_t> video(4096);
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (std::uint32_t sweep = 0; sweep < 20; ++sweep) {
      // A range so long that every sample is a resolution cell of its own.
      reference.form_video({power, power, power, 0.0, 0.0, row.looks}, geo::Length::metres(4e6), 3, {99, 1, sweep},
                           video);
      for (const std::uint8_t level : video) {
        const double db = level / 255.0 * 60.0;
        sum += db;
        squares += db * db;
        count += 1.0;
      }
    }
    const double deviation = std::sqrt(squares / count - sum / count * sum / count);
    EXPECT_NEAR(deviation, row.deviation_db, 0.05 * row.deviation_db) << row.looks << " looks";
  }
}

TEST(Reference, AGainStepReducesTheVideoByItsDecibels) {
  Reference reference(bare_configuration(16));
  const std::vector<float> power(16, 0.1F);
  std::vector<std::uint8_t> full(16), lower(16);
  reference.form_video({power, power, power}, geo::Length::metres(kRange_m), 3, {}, full);
  reference.form_video({power, power, power}, geo::Length::metres(kRange_m), 2, {}, lower);
  const radar::ReceiverConfiguration receiver;
  EXPECT_NEAR(full[0] - lower[0], 255.0 * receiver.gain_step_db / receiver.dynamic_range_db, 1.0);
}

TEST(Reference, TheVideoLevelIsTheLogarithmOfPower) {
  radar::RadarConfiguration configuration = bare_configuration(3);
  configuration.receiver.dynamic_range_db = 45.0;
  configuration.receiver.noise_floor_db = -38.0;
  configuration.receiver.stc_exponent = 0.0;
  Reference reference(configuration);
  const std::vector<float> power{1.0F, 0.1F, 0.0F};
  std::vector<std::uint8_t> video(3);
  reference.form_video({power, power, power}, geo::Length::metres(kRange_m), 3, {}, video);
  EXPECT_EQ(video[0], 255);
  EXPECT_NEAR(video[1], 255.0 * (1.0 - 10.0 / 45.0), 1.0);
  EXPECT_NEAR(video[2], 255.0 * (1.0 - 38.0 / 45.0), 1.0);
}

}  // namespace
}  // namespace yars::model::rbm
