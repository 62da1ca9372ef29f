// Rain in vectors against RainPath in double precision, within the bounds stated in model/physics/rain_simd.hpp.
#include "model/physics/rain_simd.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::physics {
namespace {

constexpr double kMaxChordError_m = 10.0;
constexpr double kMaxError_db = 0.02;
constexpr double kMaxRelativeLossError = 0.001;
constexpr double kFaintest = 1e-4;  // [full scale]

TEST(RainChordInPlane, AgreesWithTheGeodesic) {
  for (const double latitude_deg : {0.0, 37.0, -60.0, 88.0, 90.0})
    for (const double bearing_deg : {0.0, 45.0, 90.0, 200.0})
      for (const double distance_m : {100.0, 30e3, 300e3, 592e3})
        for (const double turn_deg : {0.0, -7.0, 18.0, 170.0}) {
          SCOPED_TRACE(testing::Message()
                       << latitude_deg << ", " << bearing_deg << ", " << distance_m << ", " << turn_deg);
          const geo::GeoPoint apex{latitude_deg, 10.0};
          const geo::Bearing azimuth = geo::Bearing::degrees(bearing_deg);
          const geo::GeoPoint centre =
              geo::geodesic_direct(apex, azimuth + geo::Angle::degrees(turn_deg), geo::Length::metres(distance_m));
          const geo::LocalTangentFrame frame(apex, geo::HeightAboveEllipsoid::metres(0.0));
          const geo::Vector3 enu = frame.enu_from_geodetic(centre, geo::HeightAboveEllipsoid::metres(0.0));
          const double sine = std::sin(azimuth.radians()), cosine = std::cos(azimuth.radians());
          const RainChord exact = rain_chord(apex, azimuth, centre, 100e3);
          const RainChord found = rain_chord_in_plane(enu.x * sine + enu.y * cosine, enu.x * cosine - enu.y * sine,
                                                      geo::radius_of_curvature(latitude_deg, azimuth).metres(), 100e3);
          EXPECT_NEAR(found.middle_m, exact.middle_m, kMaxChordError_m);
          if (exact.depth <= 0.0) continue;
          const auto miss_m = [](const RainChord& chord) { return 100e3 * std::sqrt(1.0 - chord.depth); };
          EXPECT_NEAR(miss_m(found), miss_m(exact), kMaxChordError_m);
        }
}

struct Rain {
  std::vector<float> power, transmission;
};

// A sweep over uneven ground with voids and ridges.
class Sweep {
 public:
  Sweep(const radar::RadarConfiguration& configuration, std::size_t samples, double altitude_m, double elevation_deg)
      : configuration_(configuration),
        geometry_(test::geometry_north(altitude_m, 74080.0)),
        receiver_(Receivers(configuration_).at(geometry_.range)),
        distance_m_(samples + terrain::kRunSlack),
        elevation_m_(distance_m_),
        horizon_(distance_m_) {
    geometry_.elevation = geo::Angle::degrees(elevation_deg);
    double horizon = -1e30;
    for (std::size_t i = 0; i < samples; ++i) {
      const double distance_m = 74080.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(samples);
      const double height_m = 800.0 + 700.0 * std::sin(distance_m / 900.0) * std::cos(distance_m / 7000.0);
      const bool is_void = i % 13 == 12;
      distance_m_[i] = static_cast<float>(distance_m);
      elevation_m_[i] = is_void ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(height_m);
      if (!is_void) horizon = std::max(horizon, earth_.sight(altitude_m, distance_m, height_m).tangent);
      horizon_[i] = static_cast<float>(horizon);
    }
  }

  Rain fast() const {
    const std::size_t samples = distance_m_.size() - terrain::kRunSlack;
    RainSamples rain(configuration_, samples);
    rain.enter(geometry_);
    EXPECT_FALSE(rain.dry());
    rain.measure(geometry_, earth_, receiver_, {distance_m_.data(), elevation_m_.data(), horizon_.data()});
    return {{rain.power(), rain.power() + samples}, {rain.transmission(), rain.transmission() + samples}};
  }

  void expect_fast_within_bounds() const {
    RainPath rain(configuration_);
    rain.enter(geometry_);
    const Rain found = fast();
    const double altitude_m = geometry_.altitude.metres();
    for (std::size_t i = 0; i < found.power.size(); ++i) {
      const auto distance_m = static_cast<double>(distance_m_[i]);
      const double height_m = std::isnan(elevation_m_[i]) ? 0.0 : static_cast<double>(elevation_m_[i]);
      const double slant_m = earth_.sight(altitude_m, distance_m, height_m).slant_range_m;
      const double horizon_rad = std::atan(static_cast<double>(horizon_[i]));
      const double power =
          received(receiver_, rain.power(receiver_, earth_, geometry_, distance_m, horizon_rad), slant_m);
      const double loss_db =
          -10.0 * std::log10(rain.two_way_transmission(earth_, altitude_m, distance_m, height_m, slant_m));
      const double found_db = -10.0 * std::log10(static_cast<double>(found.transmission[i]));
      EXPECT_NEAR(static_cast<double>(found.power[i]), power,
                  (std::pow(10.0, kMaxError_db / 10.0) - 1.0) * std::max(power, kFaintest))
          << i;
      EXPECT_LE(found.transmission[i], 1.0F) << i;
      // exp2() of the fast path is limited to 2^-126, 379 dB.
      EXPECT_NEAR(found_db, std::min(loss_db, 379.3), std::max(kMaxError_db, kMaxRelativeLossError * loss_db)) << i;
    }
  }

 private:
  radar::RadarConfiguration configuration_;
  SweepGeometry geometry_;
  EffectiveEarth earth_{8.5e6};
  Receiver receiver_;
  std::vector<float> distance_m_, elevation_m_, horizon_;
};

geo::GeoPoint shower_position(double distance_m, double bearing_deg) {
  return geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(bearing_deg), geo::Length::metres(distance_m));
}

radar::RadarConfiguration scattered() {
  radar::RadarConfiguration configuration;
  for (int i = 0; i < 16; ++i)
    configuration.world.rain.cells.push_back({shower_position(1000.0 + 4500.0 * i, 3.0 * (i % 5) - 6.0),
                                              3000.0 + 900.0 * (i % 7), 5.0 + 3.0 * i, 1500.0 + 800.0 * (i % 9)});
  return configuration;
}

radar::RadarConfiguration stacked() {
  radar::RadarConfiguration configuration;
  for (int i = 0; i < 64; ++i)
    configuration.world.rain.cells.push_back({shower_position(30000.0, 1.0), 9000.0, 10.0, 3000.0 + 50.0 * i});
  return configuration;
}

TEST(RainSamples, AreWithinTheirBoundsForEveryBeam) {
  for (const auto pattern : {radar::BeamPattern::hard_edge, radar::BeamPattern::gaussian,
                             radar::BeamPattern::cosecant_squared, radar::BeamPattern::mapping})
    for (const auto& [altitude_m, elevation_deg] :
         {std::tuple{200.0, 5.0}, {1000.0, 0.0}, {4500.0, -3.0}, {12000.0, -20.0}, {4500.0, -60.0}, {3000.0, 85.0}}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(pattern) << ", " << altitude_m << " m");
      radar::RadarConfiguration configuration = scattered();
      configuration.fidelity.beam = pattern;
      Sweep(configuration, 480, altitude_m, elevation_deg).expect_fast_within_bounds();
    }
}

TEST(RainSamples, AreWithinTheirBoundsFor64ShowersAtOnePlace) {
  for (const double altitude_m : {500.0, 4500.0, 15000.0}) {
    SCOPED_TRACE(altitude_m);
    Sweep(stacked(), 480, altitude_m, -2.0).expect_fast_within_bounds();
  }
}

TEST(RainSamples, AreWithinTheirBoundsForAnyNumberOfSamples) {
  for (const std::size_t samples : {1U, 15U, 16U, 17U, 191U, 4096U}) {
    SCOPED_TRACE(samples);
    Sweep(scattered(), samples, 4500.0, -3.0).expect_fast_within_bounds();
  }
}

TEST(RainSamples, AreEqualOnEveryVectorTarget) {
  for (const double altitude_m : {1000.0, 4500.0})
    for (const std::size_t samples : {17U, 480U}) {
      const Sweep sweep(scattered(), samples, altitude_m, -3.0);
      const Rain expected = sweep.fast();
      test::for_each_vector_target([&](const char* target) {
        const Rain found = sweep.fast();
        EXPECT_EQ(found.power, expected.power) << target;
        EXPECT_EQ(found.transmission, expected.transmission) << target;
      });
    }
}

TEST(RainSamples, AreDryOnTheFarSideOfTheEarth) {
  radar::RadarConfiguration configuration;
  configuration.world.rain.cells.push_back(
      {{-test::kMidLatitude.latitude_deg, test::kMidLatitude.longitude_deg + 180.0}, 9000.0, 10.0, 3000.0});
  RainSamples rain(configuration, 16);
  rain.enter(test::geometry_north(3000.0, 74080.0));
  EXPECT_TRUE(rain.dry());
}

}  // namespace
}  // namespace yars::model::physics
