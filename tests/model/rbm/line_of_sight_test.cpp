// Shadow of the algorithm `reference` against brute force over all pairs of samples. Brute force uses vectors from the
// centre of the effective earth.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "model/rbm/reference.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/physics/ground.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::model::rbm {
namespace {

struct Vector {
  double x, y, z;
};
Vector operator-(Vector a, Vector b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Position of a point relative to the earth's centre. Axes: x north, y east, z up at the apex. `radius_m`: effective
// earth radius. The distance is over ground from the apex.
Vector point(double radius_m, double azimuth_rad, double distance_m, double height_m) {
  const double angle = distance_m / radius_m;
  const double out = (radius_m + height_m) * std::sin(angle);
  return {out * std::cos(azimuth_rad), out * std::sin(azimuth_rad), (radius_m + height_m) * std::cos(angle)};
}

// True: visible from `eye`. False: hidden by a nearer sample. nullopt: rounding decides.
std::optional<bool> visible(const std::vector<Vector>& ground, const std::vector<bool>& known, Vector eye, Vector side,
                            std::size_t target) {
  constexpr double kTie = 1e-12;  // sine of an angle between two lines of sight
  bool tie = false;
  const Vector to_target = ground[target] - eye;
  for (std::size_t i = 0; i < target; ++i) {
    if (!known[i]) continue;
    const Vector to_other = ground[i] - eye;
    const double sine =
        dot(cross(to_other, to_target), side) / std::sqrt(dot(to_other, to_other) * dot(to_target, to_target));
    if (sine > kTie) return false;
    tie = tie || sine > -kTie;
  }
  if (tie) return std::nullopt;
  return true;
}

// Returns the number of hidden samples. Brute force knows the ground at samples only. Ground between samples may hide
// more, so samples that brute force sees are not compared.
int expect_equal_to_brute_force(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  radar::RadarConfiguration configuration = test::bare_configuration(400);
  configuration.fidelity.earth = radar::EarthModel::ellipsoid;
  configuration.fidelity.earth_radius_factor = 4.0 / 3.0;
  const auto samples = test::seen_by_reference(configuration, geometry, terrain);
  const double radius_m = 4.0 / 3.0 * geo::radius_of_curvature(geometry.apex.latitude_deg, geometry.azimuth).metres();
  const double azimuth_rad = geometry.azimuth.radians();
  // Normal of the plane of the sweep. The sine in visible() is positive if the other sample is higher.
  const Vector side{-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0};
  const Vector eye = point(radius_m, azimuth_rad, 0.0, geometry.altitude.metres());
  std::vector<Vector> ground;
  std::vector<bool> known;
  for (const auto& sample : samples) {
    known.push_back(!std::isnan(sample.height_m));
    ground.push_back(point(radius_m, azimuth_rad, sample.distance_m, known.back() ? sample.height_m : 0.0));
  }
  int hidden = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!known[i]) continue;
    const std::optional<bool> seen = visible(ground, known, eye, side, i);
    if (!seen) continue;
    hidden += *seen ? 0 : 1;
    if (*seen) continue;
    EXPECT_FALSE(samples[i].lit) << "sample " << i << " at " << samples[i].distance_m << " m, azimuth "
                                 << geometry.azimuth.degrees();
  }
  return hidden;
}

TEST(LineOfSight, BruteForceAgreesOverHills) {
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(), 400.0, 9000.0));
  int hidden = 0;
  for (const double altitude_m : {300.0, 1200.0, 4500.0}) {
    for (const double azimuth_deg : {0.0, 77.0, 201.0}) {
      physics::SweepGeometry geometry = test::geometry_north(altitude_m, 100000.0);
      geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
      hidden += expect_equal_to_brute_force(geometry, hills);
    }
  }
  EXPECT_GT(hidden, 500);
}

TEST(LineOfSight, BruteForceAgreesBeyondTheHorizonOfTheSea) {
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  EXPECT_GT(expect_equal_to_brute_force(test::geometry_north(1000.0, 296320.0), sea), 200);
}

TEST(LineOfSight, BruteForceAgreesOverRealGround) {
  YARS_NEEDS_SHARED_DATA();
  auto store = terrain::open_terrain({(test::shared_data() / "dted").string(), true});
  ASSERT_TRUE(store) << store.error().message();
  const geo::GeoPoint apex{37.6, -122.9};
  const auto view = (*store)->prepare({apex, 150000.0});
  int hidden = 0;
  for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 15) {
    const physics::SweepGeometry geometry{apex, geo::AltitudeMsl::feet(15000.0), geo::Bearing::degrees(azimuth_deg),
                                          geo::Angle(), geo::Length::nautical_miles(80.0)};
    hidden += expect_equal_to_brute_force(geometry, *view);
  }
  EXPECT_GT(hidden, 500);
}

}  // namespace
}  // namespace yars::model::rbm
