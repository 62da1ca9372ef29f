// Sub-beams (several rays across the beam): rays that successive sweeps share, rays of point targets, and the ray that
// determines light and shadow.
#include "model/rbm/beam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/made_up_objects.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

constexpr std::size_t kBeamSamples = 240;

radar::RadarConfiguration with_rays(int rays, radar::Algorithm algorithm = radar::Algorithm::reference) {
  radar::RadarConfiguration configuration = test::bare_configuration(static_cast<int>(kBeamSamples));
  configuration.fidelity.algorithm = algorithm;
  configuration.fidelity.sub_beams = rays;
  return configuration;
}

physics::SweepGeometry towards(double azimuth_deg) {
  physics::SweepGeometry geometry = test::geometry_north(1000.0, 30000.0);
  geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
  return geometry;
}

// A wall of 900 m that ends 0.0002 degrees west of the meridian of the apex.
terrain::AnalyticTerrain wall_to_the_west() {
  return terrain::AnalyticTerrain([](geo::GeoPoint position) {
    const bool wall = position.latitude_deg > 37.05 && position.latitude_deg < 37.06;
    return wall && position.longitude_deg < test::kMidLatitude.longitude_deg - 0.0002 ? 900.0 : 0.0;
  });
}

std::vector<std::uint8_t> lit_by(int rays, double azimuth_deg) {
  Beam algorithm(with_rays(rays));
  std::vector<float> power(kBeamSamples);
  algorithm.measure(towards(azimuth_deg), wall_to_the_west(), power);
  std::vector<std::uint8_t> lit(kBeamSamples);
  algorithm.lit(lit);
  return lit;
}

// The spacing of rays is 1.5 beamwidths divided by their number. Their azimuths are multiples of it.
TEST(SubBeams, HaveTheShadowOfTheRayNearestTheBeamsCentre) {
  const double beam_deg = with_rays(1).antenna.azimuth_beamwidth_deg;
  for (const double azimuth_deg : {-0.9, -0.1, 0.0, 0.1, 0.5}) {
    for (const int rays : {2, 3, 4, 5, 15}) {
      const double spacing_deg = 1.5 * beam_deg / rays;
      EXPECT_EQ(lit_by(rays, azimuth_deg), lit_by(1, spacing_deg * std::round(azimuth_deg / spacing_deg)))
          << rays << ' ' << azimuth_deg;
    }
  }
}

// Weights follow the two-way pattern. Their sum is 1.
TEST(SubBeams, HaveTheWeightedPowerOfTheirRays) {
  const terrain::AnalyticTerrain hills{terrain::built_in_hills()};
  for (const double azimuth_deg : {0.1, 40.0, 359.83}) {
    std::vector<float> power(kBeamSamples), ray(kBeamSamples);
    Beam(with_rays(15)).measure(towards(azimuth_deg), hills, power);
    std::vector<double> sum(kBeamSamples);
    double weights = 0.0;
    for (int number = -10; number <= 1500; ++number) {
      const double offset = (0.25 * number - azimuth_deg) / 2.5;  // [beamwidths] the spacing of rays is 0.25 degrees
      if (!(offset >= -0.75 && offset < 0.75)) continue;
      Beam(with_rays(1)).measure(towards(0.25 * number), hills, ray);
      const double weight = std::exp(-physics::kTwoWayExponent * offset * offset);
      weights += weight;
      for (std::size_t i = 0; i < kBeamSamples; ++i) sum[i] += weight * static_cast<double>(ray[i]);
    }
    for (std::size_t i = 0; i < kBeamSamples; ++i)
      EXPECT_NEAR(power[i], sum[i] / weights, 1e-5 * sum[i] / weights) << azimuth_deg << ' ' << i;
  }
}

// An algorithm of one ray that notes how it is called. Its power is 1.
class Notes : public Algorithm {
 public:
  explicit Notes(std::vector<physics::SweepGeometry>& measured) : measured_(&measured) {}
  std::size_t measure(const physics::SweepGeometry& geometry, const physics::Environment& /*environment*/,
                      std::span<float> power) override {
    measured_->push_back(geometry);
    std::fill(power.begin(), power.end(), 1.0F);
    return 3;
  }
  void lit(std::span<std::uint8_t> /*mask*/) const override {}
  bool has_points() const override { return false; }
  void form_video(const physics::PowerWindow& /*window*/, geo::Length /*range*/, int /*gain*/,
                  const physics::NoiseKey& /*key*/, std::span<std::uint8_t> /*video*/) override {}

 private:
  std::vector<physics::SweepGeometry>* measured_;
};

class SubBeamsOverNotes : public ::testing::Test {
 protected:
  // Number of rays that the sweep measures.
  std::size_t rays_of(const physics::SweepGeometry& geometry) {
    measured.clear();
    std::vector<float> power(kBeamSamples);
    pending = beam.measure(geometry, flat, power);
    for (const float value : power) EXPECT_NEAR(value, 1.0F, 1e-6F);
    return measured.size();
  }
  std::vector<physics::SweepGeometry> measured;
  Beam beam{std::make_unique<Notes>(measured), with_rays(15)};
  terrain::AnalyticTerrain flat{terrain::flat(0.0)};
  std::size_t pending = 0;
};

TEST_F(SubBeamsOverNotes, MeasureOnlyTheRaysThatTheBeamReaches) {
  // The spacing of the rays is 0.25 degrees.
  EXPECT_EQ(rays_of(towards(359.0)), 15U);
  EXPECT_EQ(beam.rays(), 15U);
  EXPECT_EQ(rays_of(towards(359.0)), 0U);
  EXPECT_EQ(pending, 45U) << "of kept rays, too";
  EXPECT_EQ(rays_of(towards(359.5)), 2U);
  EXPECT_EQ(beam.rays(), 17U);
  EXPECT_EQ(rays_of(towards(0.25)), 3U) << "across north";
  EXPECT_EQ(rays_of(towards(359.75)), 2U) << "back";
  EXPECT_EQ(rays_of(towards(90.0)), 15U);
  for (const physics::SweepGeometry& ray : measured) EXPECT_EQ(std::remainder(ray.azimuth.degrees(), 0.25), 0.0);
}

TEST_F(SubBeamsOverNotes, MeasureRaysAgainInTheNextPassAndWhenTheGeometryIsAnother) {
  physics::SweepGeometry geometry = towards(10.0);
  EXPECT_EQ(rays_of(geometry), 15U);
  beam.begin_pass();
  EXPECT_EQ(rays_of(geometry), 15U);
  geometry.elevation = geo::Angle::degrees(1.0);
  EXPECT_EQ(rays_of(geometry), 15U) << "elevation";
  geometry.range = geo::Length::metres(20000.0);
  EXPECT_EQ(rays_of(geometry), 15U) << "range";
  geometry.sim_time = geo::Duration::seconds(0.9 * Beam::kRayLifetime.seconds());
  EXPECT_EQ(rays_of(geometry), 0U);
  geometry.sim_time = geo::Duration::seconds(1.1 * Beam::kRayLifetime.seconds());
  EXPECT_EQ(rays_of(geometry), 15U) << "lifetime";
  // Half a sample is 41.7 m.
  geometry.apex = geo::geodesic_direct(geometry.apex, geo::Bearing::degrees(60.0), geo::Length::metres(41.0));
  EXPECT_EQ(rays_of(geometry), 0U);
  geometry.apex = geo::geodesic_direct(geometry.apex, geo::Bearing::degrees(60.0), geo::Length::metres(1.0));
  EXPECT_EQ(rays_of(geometry), 15U) << "position";
  geometry.altitude = geo::AltitudeMsl::metres(1042.0);
  EXPECT_EQ(rays_of(geometry), 15U) << "altitude";
}

// 250 m/s, 110 degrees a second. In the 50 ms of a ray the aircraft flies 12.5 m; half a sample is 41.7 m.
TEST_F(SubBeamsOverNotes, MeasureEachRayOnceInFlight) {
  physics::SweepGeometry geometry = towards(300.0);
  std::size_t rays = 0;
  for (int sweep = 0; sweep < 182; ++sweep) {
    geometry.azimuth = geo::Bearing::degrees(300.0 + 0.55 * sweep);
    geometry.apex = geo::geodesic_direct(geometry.apex, geo::Bearing::degrees(20.0), geo::Length::metres(1.25));
    geometry.sim_time = geo::Duration::seconds(0.005 * sweep);
    rays += rays_of(geometry);
  }
  EXPECT_NEAR(static_cast<double>(rays), 15.0 + 0.55 * 181.0 / 0.25, 1.0);
}

// Hills, a mover 10 km away, and houses.
struct World {
  radar::RadarConfiguration configuration = with_rays(13, radar::Algorithm::standard);
  terrain::AnalyticTerrain hills{terrain::built_in_hills()};
  scene::SceneViewPointer houses;
  World() {
    radar::Mover mover;
    mover.position = geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(3.0), geo::Length::metres(10e3));
    mover.speed_mps = 200.0;
    mover.heading_deg = 90.0;
    configuration.world.movers.push_back(mover);
    houses =
        test::scene_of({test::Building{}, {0.0, 900.0, 45.0, 1800.0, 0.0, 9}},
                       geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(-2.0), geo::Length::metres(20e3)),
                       0.0, terrain::built_in_hills());
  }
};

TEST(SubBeams, OfAHoveringAircraftDoNotDependOnEarlierSweeps) {
  World world;
  Beam kept(world.configuration);
  for (int sweep = 0; sweep < 40; ++sweep) {
    physics::SweepGeometry geometry = towards(-8.0 + 0.549 * (sweep < 30 ? sweep : 60 - sweep));
    geometry.sim_time = geo::Duration::seconds(0.005 * sweep);
    std::vector<float> power(kBeamSamples), alone(kBeamSamples);
    kept.measure(geometry, {world.hills, world.houses.get()}, power);
    Beam(world.configuration).measure(geometry, {world.hills, world.houses.get()}, alone);
    ASSERT_EQ(power, alone) << sweep;
  }
}

TEST(SubBeams, HaveTheSamePowerOnEveryVectorTarget) {
  for (const int samples : {1, 37, 240}) {
    World world;
    world.configuration.fidelity.samples = samples;
    std::vector<float> first;
    test::for_each_vector_target([&](const char* name) {
      std::vector<float> power(static_cast<std::size_t>(samples));
      Beam(world.configuration).measure(towards(1.0), {world.hills, world.houses.get()}, power);
      if (first.empty()) first = power;
      EXPECT_EQ(power, first) << name << ' ' << samples;
    });
  }
}

double sum_of(const std::vector<float>& power) {
  double sum = 0.0;
  for (const float value : power) sum += static_cast<double>(value);
  return sum;
}

// What a mover adds has the beam's pattern, whichever ray collects it.
TEST(SubBeams, GiveAMoverTheGainOfItsAzimuthOffTheBeamsCentre) {
  for (const int rays : {2, 5, 7, 13, 15}) {
    radar::RadarConfiguration empty = with_rays(rays, radar::Algorithm::standard), busy = empty;
    radar::Mover mover;
    mover.position = geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(0.0), geo::Length::metres(10e3));
    mover.cross_section_m2 = 1e5;
    busy.world.movers.push_back(mover);
    const terrain::AnalyticTerrain flat(terrain::flat(0.0));
    Beam with(busy), without(empty);
    const auto added = [&](double azimuth_deg) {
      std::vector<float> power(kBeamSamples), ground(kBeamSamples);
      with.measure(towards(azimuth_deg), flat, power);
      without.measure(towards(azimuth_deg), flat, ground);
      return sum_of(power) - sum_of(ground);
    };
    const double most = added(0.0);
    const double beam_deg = busy.antenna.azimuth_beamwidth_deg;
    for (const double off : {-1.2, -0.8, -0.5, -0.26, 0.1, 0.3, 0.6, 0.74, 0.76, 1.1})
      EXPECT_NEAR(added(off * beam_deg) / most, std::exp(-physics::kTwoWayExponent * off * off), 2e-3)
          << rays << ' ' << off;
  }
}

// In flight a ray may have been measured 12 m behind the aircraft and 5 m above or below it. What lies on the ground is
// as bright as over new rays.
TEST(SubBeams, OfAFlyingAircraftLightPointsAsNewRaysDo) {
  radar::RadarConfiguration empty = with_rays(4, radar::Algorithm::standard), busy = empty;
  const geo::GeoPoint place =
      geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(1.0), geo::Length::metres(10e3));
  radar::Mover mover;
  mover.position = place;
  mover.height_m = 2.0;
  mover.cross_section_m2 = 1e5;
  busy.world.movers.push_back(mover);
  const terrain::AnalyticTerrain flat(terrain::flat(0.0));
  const auto house = test::scene_of({test::Building{}}, place);
  for (const double climb_mps : {-100.0, 0.0, 100.0}) {
    Beam with(busy), without(empty);
    physics::SweepGeometry geometry = towards(-2.0);
    for (int sweep = 0; sweep < 14; ++sweep) {
      geometry.azimuth = geo::Bearing::degrees(-2.0 + 0.5 * sweep);
      geometry.apex = geo::geodesic_direct(geometry.apex, geo::Bearing::degrees(0.0), geo::Length::metres(1.25));
      geometry.altitude = geo::AltitudeMsl::metres(geometry.altitude.metres() + 0.005 * climb_mps);
      geometry.sim_time = geo::Duration::seconds(0.005 * sweep);
      const auto added = [&](Beam& points, Beam& none) {
        std::vector<float> power(kBeamSamples), ground(kBeamSamples);
        points.measure(geometry, {flat, house.get()}, power);
        none.measure(geometry, flat, ground);
        return sum_of(power) - sum_of(ground);
      };
      Beam new_with(busy), new_without(empty);
      const double expected = added(new_with, new_without);
      EXPECT_GT(expected, 0.0);
      EXPECT_NEAR(added(with, without), expected, 1e-3 * expected) << climb_mps << ' ' << sweep;
    }
  }
}

// Walls of 900 m, 5 km away, at azimuths from `from_deg` to `to_deg`.
terrain::AnalyticTerrain::Height wall_between(std::vector<std::pair<double, double>> sectors) {
  return [sectors](geo::GeoPoint position) {
    const geo::GeodesicInverse path = geo::geodesic_inverse(test::kMidLatitude, position);
    const double distance_m = path.distance.metres(),
                 azimuth_deg = geo::wrapped_degrees(path.azimuth_at_start.degrees());
    const bool wall =
        distance_m > 5000.0 && distance_m < 5300.0 &&
        std::any_of(
            sectors.begin(), sectors.end(),
            [&](const auto& sector) { return azimuth_deg > sector.first && azimuth_deg < sector.second; });
    return wall ? 900.0 : 0.0;
  };
}

// The rays of `standard` are 0.94 degrees apart. A mover at 0.45 degrees lies between two of them.
TEST(SubBeams, LightAMoverAlongItsOwnAzimuth) {
  radar::RadarConfiguration empty = with_rays(4, radar::Algorithm::standard);
  for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference}) {
    empty.fidelity.algorithm = algorithm;
    radar::RadarConfiguration busy = empty;
    radar::Mover mover;
    mover.position = geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(0.45), geo::Length::metres(10e3));
    busy.world.movers.push_back(mover);
    const auto added = [&](const terrain::AnalyticTerrain::Height& height) {
      const terrain::AnalyticTerrain ground(height);
      std::vector<float> power(kBeamSamples), without(kBeamSamples);
      Beam(busy).measure(towards(0.45), ground, power);
      Beam(empty).measure(towards(0.45), ground, without);
      return sum_of(power) - sum_of(without);
    };
    const double free = added(wall_between({}));
    EXPECT_GT(free, 0.0);
    EXPECT_NEAR(added(wall_between({{-0.3, 0.2}, {0.7, 1.2}})), free, 1e-3 * free) << "hills before the rays alone";
    EXPECT_NEAR(added(wall_between({{0.1, 0.8}})), 0.0, 1e-3 * free) << "a hill before the mover alone";
  }
}

// A house between two rays, of which one is hidden.
TEST(SubBeams, LightAHouseByTheTwoRaysBesideIt) {
  radar::RadarConfiguration configuration = with_rays(4, radar::Algorithm::standard);
  const auto house = test::scene_of(
      {test::Building{}},
      geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(0.25 * 0.9375), geo::Length::metres(10e3)));
  const auto added = [&](const terrain::AnalyticTerrain::Height& height) {
    const terrain::AnalyticTerrain ground(height);
    std::vector<float> power(kBeamSamples), without(kBeamSamples);
    Beam(configuration).measure(towards(0.2), {ground, house.get()}, power);
    Beam(configuration).measure(towards(0.2), ground, without);
    return sum_of(power) - sum_of(without);
  };
  const double free = added(wall_between({}));
  EXPECT_NEAR(added(wall_between({{0.8, 1.1}})) / free, 0.75, 0.01);
  EXPECT_NEAR(added(wall_between({{-0.1, 0.1}})) / free, 0.25, 0.01);
}

}  // namespace
}  // namespace yars::model::rbm
