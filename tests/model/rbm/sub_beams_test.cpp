// Sub-beams (several rays across the beam): the ray that determines light and shadow.
#include "model/rbm/sub_beams.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

// A wall of 900 m that ends 0.0002 degrees west of the meridian of the apex.
terrain::AnalyticTerrain wall_to_the_west() {
  return terrain::AnalyticTerrain([](geo::GeoPoint position) {
    const bool wall = position.latitude_deg > 37.05 && position.latitude_deg < 37.06;
    return wall && position.longitude_deg < test::kMidLatitude.longitude_deg - 0.0002 ? 900.0 : 0.0;
  });
}

std::vector<std::uint8_t> lit_by(int rays, double azimuth_deg) {
  radar::RadarConfiguration configuration = test::bare_configuration(240);
  configuration.fidelity.sub_beams = rays;
  const auto algorithm = make_algorithm(configuration);
  physics::SweepGeometry geometry = test::geometry_north(1000.0, 30000.0);
  geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
  std::vector<float> power(240);
  algorithm->measure(geometry, wall_to_the_west(), power);
  std::vector<std::uint8_t> lit(240);
  algorithm->lit(lit);
  return lit;
}

TEST(SubBeams, HaveTheShadowOfTheMiddleRay) {
  for (const double azimuth_deg : {-0.5, 0.0, 0.5})
    for (const int rays : {3, 5, 15}) EXPECT_EQ(lit_by(rays, azimuth_deg), lit_by(1, azimuth_deg)) << azimuth_deg;
}

// The spacing of rays is 1.5 beamwidths divided by their number. The right ray of the middle pair is half a spacing to
// the right of the beam's centre.
TEST(SubBeams, OfAnEvenNumberHaveTheShadowOfTheRightRayOfTheMiddlePair) {
  const double beam_deg = test::bare_configuration(240).antenna.azimuth_beamwidth_deg;
  for (const double azimuth_deg : {-0.9, -0.1, 0.5}) {
    EXPECT_EQ(lit_by(2, azimuth_deg), lit_by(1, azimuth_deg + 0.375 * beam_deg)) << azimuth_deg;
    EXPECT_EQ(lit_by(4, azimuth_deg), lit_by(1, azimuth_deg + 0.1875 * beam_deg)) << azimuth_deg;
  }
}

}  // namespace
}  // namespace yars::model::rbm
