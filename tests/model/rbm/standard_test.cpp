// The algorithm `standard` against the algorithm `reference`, within the bounds stated in model/rbm/standard.hpp.
#include "model/rbm/standard.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <vector>

#include "model/physics/polynomials-inl.hpp"
#include "model/rbm/beam.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/physics/ground.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::model::rbm {
namespace {

// Tests the vector target for which this file is compiled. The errors do not depend on the target.
TEST(VectorPolynomials, AreWithinTheirStatedErrors) {
  namespace hn = hwy::HWY_NAMESPACE;
  namespace lane = physics::HWY_NAMESPACE;
  const hn::CappedTag<float, 1> d;
  const auto of = [&](float value) { return hn::Set(d, value); };
  for (float x = 1e-30F; x < 1e30F; x *= 1.0173F) {
    const double exact = std::log2(static_cast<double>(x));
    EXPECT_NEAR(static_cast<double>(hn::GetLane(lane::log2(d, of(x)))), exact, 4e-7 + 6e-8 * std::abs(exact)) << x;
    EXPECT_NEAR(static_cast<double>(hn::GetLane(lane::inverse_root(d, of(x)))) * std::sqrt(static_cast<double>(x)), 1.0,
                5e-6)
        << x;
    EXPECT_NEAR(static_cast<double>(hn::GetLane(lane::rough_log2(d, of(x)))), exact, 1.3e-4) << x;
  }
  for (float x = -125.0F; x < 120.0F; x += 0.0137F) {
    const double exact = std::exp2(static_cast<double>(x));
    EXPECT_NEAR(static_cast<double>(hn::GetLane(lane::exp2(d, of(x)))) / exact, 1.0, 3e-7) << x;
  }
  for (double x = 0.0; x < 3.1415; x += 0.00137) {
    const auto angle = lane::angle(d, of(static_cast<float>(std::sin(x))), of(static_cast<float>(std::cos(x))));
    EXPECT_NEAR(static_cast<double>(hn::GetLane(angle)), x, 1.3e-6);
  }
}

Beam one_ray(radar::RadarConfiguration configuration, radar::Algorithm algorithm) {
  configuration.fidelity.sub_beams = 1;
  configuration.fidelity.algorithm = algorithm;
  return Beam(configuration);
}

struct Difference {
  double shadow_share = 0.0;  // fraction of samples that are dark in exactly one result
  double rms = 0.0;  // RMS difference of the video [gray levels], farther than kEdge samples from a shadow's edge
  double dark_share = 0.0;  // fraction of dark samples of `reference`
  double power_db = 0.0;    // mean power of `standard` over that of `reference`
};
// Cells at the edge of a shadow are seen in part. There a small error of the part is many decibels of the power.
constexpr std::size_t kEdge = 2;

// Difference of both algorithms over 21 sweeps, up to 50 degrees either side of `first`.
Difference difference(radar::RadarConfiguration configuration, const physics::SweepGeometry& first,
                      const terrain::TerrainView& terrain) {
  configuration.fidelity.noise = false;
  Beam reference = one_ray(configuration, radar::Algorithm::reference);
  Beam standard = one_ray(configuration, radar::Algorithm::standard);
  const std::size_t count = sample_count(configuration);
  std::vector<float> exact(count), fast(count);
  std::vector<std::uint8_t> exact_video(count), fast_video(count), exact_lit(count), fast_lit(count);
  double squares = 0.0, compared = 0.0, mismatches = 0.0, dark = 0.0, total = 0.0, exact_sum = 0.0, fast_sum = 0.0;
  for (double turn_deg = -50.0; turn_deg <= 50.0; turn_deg += 5.0) {
    physics::SweepGeometry geometry = first;
    geometry.azimuth = first.azimuth + geo::Angle::degrees(turn_deg);
    reference.measure(geometry, terrain, exact);
    standard.measure(geometry, terrain, fast);
    reference.lit(exact_lit);
    standard.lit(fast_lit);
    reference.form_video({exact, exact, exact}, geometry.range, 3, {}, exact_video);
    standard.form_video({fast, fast, fast}, geometry.range, 3, {}, fast_video);
    for (std::size_t i = 0; i < count; ++i) {
      mismatches += exact_lit[i] != fast_lit[i] ? 1.0 : 0.0;
      dark += exact_lit[i] != 0 ? 0.0 : 1.0;
      total += 1.0;
      exact_sum += static_cast<double>(exact[i]);
      fast_sum += static_cast<double>(fast[i]);
      const auto from = exact_lit.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, kEdge));
      const auto to = exact_lit.begin() + static_cast<std::ptrdiff_t>(std::min(i + kEdge + 1, count));
      if (std::any_of(from, to, [&](std::uint8_t lit) { return lit != *from; })) continue;
      squares += std::pow(static_cast<double>(exact_video[i]) - static_cast<double>(fast_video[i]), 2.0);
      compared += 1.0;
    }
  }
  return {mismatches / total, std::sqrt(squares / compared), dark / total, 10.0 * std::log10(fast_sum / exact_sum)};
}

// Over ground without posts. There `reference` finds shadow between samples, and `standard` does not.
void expect_within_bounds(const Difference& found) {
  EXPECT_LE(found.shadow_share, 0.012);
  EXPECT_LE(found.rms, 0.8);
  EXPECT_LE(std::abs(found.power_db), 0.1);
  EXPECT_GT(found.dark_share, 0.02);
}

radar::RadarConfiguration sharp_configuration() {
  radar::RadarConfiguration configuration;
  configuration.fidelity.pulse_smear = false;  // so that each sample has its own ground alone
  return configuration;
}

physics::SweepGeometry geometry_from(geo::GeoPoint apex, double azimuth_deg, double range_nm) {
  return {apex, geo::AltitudeMsl::feet(15000.0), geo::Bearing::degrees(azimuth_deg), geo::Angle::degrees(-3.0),
          geo::Length::nautical_miles(range_nm)};
}

TEST(Standard, AgreesWithTheReferenceOverHillsAtMidLatitude) {
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(), 600.0, 12000.0));
  for (const double range_nm : {10.0, 40.0, 160.0}) {
    SCOPED_TRACE(range_nm);
    physics::SweepGeometry geometry = geometry_from(test::kMidLatitude, 20.0, range_nm);
    geometry.altitude = geo::AltitudeMsl::metres(1500.0);
    expect_within_bounds(difference(sharp_configuration(), geometry, hills));
  }
}

TEST(Standard, AgreesWithTheReferenceOneDegreeFromThePole) {
  const geo::GeoPoint apex{89.0, 30.0};
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(apex), 600.0, 12000.0));
  expect_within_bounds(difference(sharp_configuration(), geometry_from(apex, 0.0, 160.0), hills));
}

TEST(Standard, AgreesWithTheReferenceAcrossTheAntimeridian) {
  const geo::GeoPoint apex{-17.0, 179.5};
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(apex), 600.0, 12000.0));
  expect_within_bounds(difference(sharp_configuration(), geometry_from(apex, 90.0, 160.0), hills));
}

TEST(Standard, AgreesWithTheReferenceOverRealGround) {
  YARS_NEEDS_SHARED_DATA();
  auto store = terrain::open_terrain({(test::shared_data() / "dted").string(), true});
  ASSERT_TRUE(store) << store.error().message();
  const geo::GeoPoint apex{37.6, -122.9};
  for (const double range_nm : {10.0, 40.0, 80.0, 160.0}) {
    SCOPED_TRACE(range_nm);
    const physics::SweepGeometry geometry = geometry_from(apex, 60.0, range_nm);
    const auto view = (*store)->prepare({apex, geometry.range.metres()});
    const Difference found = difference(sharp_configuration(), geometry, *view);
    EXPECT_LE(found.shadow_share, 0.005);
    // `standard` does not know where between two samples a crest is that hides a part of the ground behind it.
    EXPECT_LE(found.rms, 2.5 + 3.0 * range_nm / 160.0);
    EXPECT_LE(std::abs(found.power_db), 0.02);
  }
}

TEST(Standard, AgreesWithTheReferenceForOtherFidelities) {
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(), 600.0, 12000.0));
  const physics::SweepGeometry geometry = geometry_from(test::kMidLatitude, 200.0, 40.0);
  for (const auto beam : {radar::BeamPattern::hard_edge, radar::BeamPattern::gaussian,
                          radar::BeamPattern::cosecant_squared, radar::BeamPattern::mapping}) {
    for (const auto earth : {radar::EarthModel::flat, radar::EarthModel::sphere}) {
      radar::RadarConfiguration configuration;
      configuration.fidelity.beam = beam;
      configuration.fidelity.earth = earth;
      configuration.fidelity.slant_range = true;
      configuration.fidelity.samples = 333;
      configuration.receiver.stc_exponent = 2.5;
      const Difference found = difference(configuration, geometry, hills);
      EXPECT_LE(found.shadow_share, 0.005) << static_cast<int>(beam);
      EXPECT_LE(std::abs(found.power_db), 0.1) << static_cast<int>(beam);
      // A hard edge of the beam falls within a cell. The ground of a cell has one slope in slant range.
      EXPECT_LE(found.rms, beam == radar::BeamPattern::hard_edge ? 7.0 : 2.5) << static_cast<int>(beam);
    }
  }
}

// Stripes of every material on hills, sea between the hills, rain and a ship.
TEST(Standard, AgreesWithTheReferenceOverABusyWorld) {
  const auto hills = terrain::sine_hills(test::axis_north(), 300.0, 9000.0);
  const terrain::AnalyticTerrain world(
      [hills](geo::GeoPoint position) { return std::max(0.0, hills(position) - 150.0); }, 1,
      [](geo::GeoPoint position) {
        return static_cast<std::uint8_t>(static_cast<int>(std::abs(position.longitude_deg) * 40.0) % 14);
      });
  radar::RadarConfiguration configuration = sharp_configuration();
  const geo::GeoPoint ahead =
      geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(200.0), geo::Length::nautical_miles(20.0));
  configuration.world.rain.cells.push_back({ahead, 15000.0, 25.0, 4000.0});
  configuration.world.movers.push_back({"ship", ahead, 8.0, 90.0, 5000.0, 12.0});
  for (const double range_nm : {10.0, 40.0, 160.0}) {
    SCOPED_TRACE(range_nm);
    const Difference found = difference(configuration, geometry_from(test::kMidLatitude, 200.0, range_nm), world);
    EXPECT_LE(found.shadow_share, 0.02);
    // `standard` takes the material in the middle of a sample for all of it: up to 20 decibels at the edge of a stripe.
    EXPECT_LE(found.rms, 11.0);
    EXPECT_LE(std::abs(found.power_db), 0.2);
  }
}

// With samples at equal steps of slant range the samples below the aircraft's height have no ground. A ship nearer than
// the first sample on the ground is added to that sample.
TEST(Standard, AShipNearerThanTheFirstGroundSampleLeavesTheAltitudeHoleDark) {
  const terrain::AnalyticTerrain sea(terrain::flat(0.0), 0, {});
  radar::RadarConfiguration configuration = sharp_configuration();
  configuration.fidelity.slant_range = true;
  configuration.fidelity.noise = false;
  const geo::GeoPoint near =
      geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(200.0), geo::Length::metres(10.0));
  configuration.world.movers.push_back({"ship", near, 0.0, 90.0, 1e9, 12.0});
  const physics::SweepGeometry geometry = geometry_from(test::kMidLatitude, 200.0, 10.0);
  const std::size_t count = sample_count(configuration);
  std::vector<float> exact(count), fast(count), without(count);
  one_ray(configuration, radar::Algorithm::reference).measure(geometry, sea, exact);
  one_ray(configuration, radar::Algorithm::standard).measure(geometry, sea, fast);
  configuration.world.movers.clear();
  one_ray(configuration, radar::Algorithm::standard).measure(geometry, sea, without);
  EXPECT_NE(fast, without) << "the ship returns";
  ASSERT_EQ(exact[100], 0.0F) << "a sample in the altitude hole";
  for (std::size_t i = 0; i < count; ++i) {
    if (exact[i] == 0.0F) {
      ASSERT_EQ(fast[i], 0.0F) << i;
    }
  }
}

TEST(Standard, EveryVectorTargetGivesTheSamePowerAndVideo) {
  const auto hills = terrain::sine_hills(test::axis_north(), 600.0, 12000.0);
  const terrain::AnalyticTerrain world(
      [hills](geo::GeoPoint position) { return std::max(0.0, hills(position) - 200.0); }, 1,
      [](geo::GeoPoint position) {
        return static_cast<std::uint8_t>(static_cast<int>(std::abs(position.longitude_deg) * 40.0) % 14);
      });
  for (const auto beam : {radar::BeamPattern::hard_edge, radar::BeamPattern::gaussian,
                          radar::BeamPattern::cosecant_squared, radar::BeamPattern::mapping}) {
    for (const int samples : {1, 2, 3, 17, 480, 4096}) {
      radar::RadarConfiguration configuration;
      configuration.fidelity.beam = beam;
      configuration.fidelity.samples = samples;
      configuration.receiver.stc_exponent = 2.5;
      const auto count = static_cast<std::size_t>(samples);
      const physics::SweepGeometry geometry = geometry_from(test::kMidLatitude, 200.0, 40.0);
      std::vector<float> first_power;
      std::vector<std::uint8_t> first_video;
      test::for_each_vector_target([&](const char* name) {
        Standard standard(configuration);
        std::vector<float> power(count);
        std::vector<std::uint8_t> video(count);
        standard.measure(geometry, world, power);
        standard.form_video({power, power, power}, geometry.range, 3, {7, 3, 11}, video);
        if (first_power.empty()) {
          first_power = power;
          first_video = video;
        }
        EXPECT_EQ(power, first_power) << name << ", " << samples << " samples";
        EXPECT_EQ(video, first_video) << name << ", " << samples << " samples";
      });
    }
  }
}

TEST(Standard, DrawsTheSameNoiseAsTheReference) {
  for (const int looks : {1, 2, 3, 4, 7, 16}) {
    radar::RadarConfiguration configuration;
    Reference reference(configuration);
    Standard standard(configuration);
    const std::vector<float> power(480, 0.02F);
    std::vector<std::uint8_t> exact(480), fast(480);
    reference.form_video({power, power, power, 0.0, 0.0, looks}, geo::Length::nautical_miles(40.0), 3, {7, 3, 11},
                         exact);
    standard.form_video({power, power, power, 0.0, 0.0, looks}, geo::Length::nautical_miles(40.0), 3, {7, 3, 11}, fast);
    for (std::size_t i = 0; i < 480; ++i) ASSERT_NEAR(exact[i], fast[i], 1) << i << " of " << looks << " looks";
  }
}

TEST(Standard, ReturnsFinitePower) {
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  const terrain::AnalyticTerrain holes([nan](geo::GeoPoint position) {
    return std::fmod(std::abs(position.latitude_deg) * 1000.0, 3.0) < 1.0
               ? nan
               : 3000.0 * std::sin(position.latitude_deg * 900.0);
  });
  const terrain::AnalyticTerrain nothing([nan](geo::GeoPoint) { return nan; });
  for (const bool slant : {false, true}) {
    radar::RadarConfiguration configuration;
    configuration.fidelity.slant_range = slant;
    Standard standard(configuration);
    std::vector<float> power(480);
    for (const double altitude_m : {-500.0, 0.0, 3000.0, 20000.0}) {
      standard.measure(test::geometry_north(altitude_m, 50000.0), holes, power);
      for (const float value : power) ASSERT_TRUE(std::isfinite(value) && value >= 0.0F) << altitude_m;
      standard.measure(test::geometry_north(altitude_m, 50000.0), nothing, power);
      for (const float value : power) ASSERT_EQ(value, 0.0F);
    }
  }
}

}  // namespace
}  // namespace yars::model::rbm
