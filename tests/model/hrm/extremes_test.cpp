// Patch maps with extreme orders: every power and the formation time are finite.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"

namespace yars::test {
namespace {

void expect_finite(const Viewpoint& view, radar::EarthModel earth = radar::EarthModel::ellipsoid) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.map_size = 96;
  configuration.fidelity.earth = earth;
  configuration.world.movers.push_back({"mover", view.target, 300.0, 45.0, 1e6, 10.0});
  const auto scene = std::make_shared<MadeUpScene>(view.target, kGround_m);
  scene->add({});
  const auto process = make_patch(configuration, order_from(view), ground_of(model::terrain::built_in_hills()), scene);
  double least = 1e30;
  for (const float power : process.image().power) {
    ASSERT_TRUE(std::isfinite(power));
    least = std::min(least, static_cast<double>(power));
  }
  EXPECT_GE(least, -1.0);
  EXPECT_TRUE(std::isfinite(process.formation().seconds()));
}

TEST(ExtremeOrder, OverThePole) {
  expect_finite({0.0, 40000.0, 5000.0, 8000.0, {89.9, 0.0}});
  expect_finite({180.0, 40000.0, 5000.0, 8000.0, {-89.9, 77.0}});
  expect_finite({0.0, 40000.0, 5000.0, 8000.0, {90.0, 0.0}});
}

TEST(ExtremeOrder, AcrossTheAntimeridian) {
  expect_finite({90.0, 40000.0, 5000.0, 8000.0, {10.0, 179.99}});
}

TEST(ExtremeOrder, StraightDownAndFromVeryHigh) {
  expect_finite({180.0, 900.0, 12000.0, 1241.0});
  expect_finite({180.0, 20000.0, 100000.0, 6000.0});
}

TEST(ExtremeOrder, LargeWindows) {
  expect_finite({180.0, 100.0 * geo::kMetresPerNauticalMile, 9000.0, 80.0 * geo::kMetresPerNauticalMile});
  expect_finite({180.0, 300.0 * geo::kMetresPerNauticalMile, 9000.0, 200.0 * geo::kMetresPerNauticalMile});
}

TEST(ExtremeOrder, FromBelowTheGroundAndBeyondTheHorizon) {
  expect_finite({180.0, 20000.0, -40.0, 6000.0});
  expect_finite({180.0, 600000.0, 500.0, 6000.0});
}

TEST(ExtremeOrder, OnAFlatEarth) {
  expect_finite({180.0, 300000.0, 100.0, 6000.0}, radar::EarthModel::flat);
}

}  // namespace
}  // namespace yars::test
