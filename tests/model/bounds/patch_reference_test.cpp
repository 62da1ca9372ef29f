// Patch maps by the algorithm `standard` against the algorithm `reference`, which computes facet by facet in double
// precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lib/radar/configuration.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/scene/openflight/reader.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::test {
namespace {

namespace terrain = model::terrain;

struct Difference {
  double power = 0.0;   // relative difference of the sums of all pixels
  double shadow = 0.0;  // fraction of pixels that are dark on exactly one map
  double rms_db = 0.0;  // RMS difference of the pixels that are lit on both maps
};

constexpr float kShadow = 0.05F;  // fraction of the power of level ground below which a pixel is dark

// `ground`: power of a pixel of level ground.
Difference compare(const hrm::MapImage& fast, const hrm::MapImage& exact, double ground) {
  double fast_sum = 0.0;
  double exact_sum = 0.0;
  double squares = 0.0;
  double lit = 0.0;
  double differ = 0.0;
  for (std::size_t i = 0; i < fast.power.size(); ++i) {
    const auto fast_power = static_cast<double>(fast.power[i]);
    const auto exact_power = static_cast<double>(exact.power[i]);
    fast_sum += fast_power;
    exact_sum += exact_power;
    const bool fast_dark = fast_power < static_cast<double>(kShadow) * ground;
    const bool exact_dark = exact_power < static_cast<double>(kShadow) * ground;
    if (fast_dark != exact_dark) differ += 1.0;
    if (fast_dark || exact_dark) continue;
    const double error_db = 10.0 * std::log10(fast_power / exact_power);
    squares += error_db * error_db;
    lit += 1.0;
  }
  return {fast_sum / exact_sum - 1.0, differ / static_cast<double>(fast.power.size()), std::sqrt(squares / lit)};
}

struct Setting {
  Viewpoint view;
  terrain::AnalyticTerrain::Height height;
  model::scene::SceneViewPointer scene;
  radar::EarthModel earth = radar::EarthModel::ellipsoid;
};

Difference measure(const char* name, const Setting& setting, int size = 192) {
  radar::RadarConfiguration configuration = bare_map(size);
  configuration.fidelity.earth = setting.earth;
  configuration.fidelity.map_response = true;
  const auto ground = ground_of(setting.height);
  const auto fast = make_patch(configuration, order_from(setting.view), ground, setting.scene);
  configuration.fidelity.algorithm = radar::Algorithm::reference;
  configuration.fidelity.geodesic_knots = 0;
  const auto exact = make_patch(configuration, order_from(setting.view), ground, setting.scene);
  const Difference found = compare(fast.image(), exact.image(), gamma_of(configuration, 0));
  std::printf("%-18s power %+.4f  shadow %.4f  rms %.2f dB\n", name, found.power, found.shadow, found.rms_db);
  return found;
}

Viewpoint view_from(double from_deg, double distance_m, double above_m, double window_m) {
  return {from_deg, distance_m, above_m, window_m, kTarget};
}

TEST(Standard, EqualsTheReferenceOverLevelGround) {
  const Setting setting{view_from(200.0, 37040.0, 4572.0, 1241.0), terrain::flat(kGround_m), {}};
  const Difference found = measure("level", setting, 96);
  EXPECT_NEAR(found.power, 0.0, 0.002);  // the refraction of the fast path: 0.12 mrad of 7 degrees
  EXPECT_EQ(found.shadow, 0.0);
  EXPECT_LT(found.rms_db, 0.02);
}

TEST(Standard, EqualsTheReferenceOverASlope) {
  const auto slope = terrain::plane({kTarget, geo::Bearing::degrees(60.0)}, kGround_m, 0.1);
  const Difference found = measure("slope", {view_from(200.0, 37040.0, 4572.0, 1241.0), slope, {}}, 96);
  EXPECT_NEAR(found.power, 0.0, 0.003);
  EXPECT_LT(found.rms_db, 0.1);
}

TEST(Standard, IsCloseToTheReferenceOverHills) {
  const auto hills = terrain::sine_hills({kTarget, geo::Bearing::degrees(30.0)}, 60.0, 1500.0);
  const Difference found = measure(
      "hills",
      {view_from(90.0, 30000.0, 2500.0, 6000.0), [&](geo::GeoPoint position) { return 5.0 + hills(position); }, {}});
  EXPECT_NEAR(found.power, 0.0, 0.01);
  EXPECT_LT(found.shadow, 0.01);
  EXPECT_LT(found.rms_db, 0.6);
}

TEST(Standard, IsCloseToTheReferenceOverACone) {
  const hrm::PatchOrder order = order_from({});
  const hrm::PatchGeometry geometry(order, radar::RadarConfiguration(), kGround_m);
  const auto cone = [&](geo::GeoPoint position) {
    const hrm::MapPoint point = geometry.point_of(position);
    return kGround_m + std::max(0.0, 80.0 - 0.3 * std::hypot(point.right_m, point.up_m));
  };
  const Difference found = measure("cone", {view_from(180.0, 20000.0, 3000.0, 1241.0), cone, {}});
  EXPECT_NEAR(found.power, 0.0, 0.01);
  EXPECT_LT(found.shadow, 0.01);
  EXPECT_LT(found.rms_db, 0.6);
}

TEST(Standard, IsCloseToTheReferenceOverBoxes) {
  for (const double from_deg : {0.0, 65.0, 300.0}) {
    const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
    scene->add({0.0, 0.0, 20.0, 80.0, 50.0, 20.0, kEarthenWorks});
    scene->add({-200.0, 150.0, 65.0, 60.0, 30.0, 12.0, kStone});
    scene->add({220.0, -180.0, 110.0, 40.0, 40.0, 30.0, kEarthenWorks});
    const Difference found =
        measure("boxes", {view_from(from_deg, 20000.0, 4000.0, 1241.0), terrain::flat(kGround_m), scene});
    EXPECT_NEAR(found.power, 0.0, 0.01);
    EXPECT_LT(found.shadow, 0.005);
    EXPECT_LT(found.rms_db, 0.8);
  }
}

// Generated airfield with hangars, towers, aircraft on wheels, and runways on the ground. Parameter: bearing [deg] from
// the airfield to the radar.
class AirfieldFrom : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Standard, AirfieldFrom, ::testing::Values(20.0, 110.0, 160.0, 250.0, 340.0));

TEST_P(AirfieldFrom, IsCloseToTheReference) {
  using namespace model::scene;
  const auto ground = ground_of(terrain::flat(kGround_m));
  const worldgen::GeneratedScene made = worldgen::generate_scene({worldgen::GeneratedKind::airfield, 5000, 1, kTarget});
  const auto model = read_openflight(made.file, "airfield");
  ASSERT_TRUE(model);
  KindTable kinds;
  const auto placed = std::make_shared<PlacedScene>(place_model(*model, {kTarget}, *ground, 0, kinds));
  const auto scene = std::make_shared<PlacedView>(1, std::vector<std::shared_ptr<const PlacedScene>>{placed},
                                                  kinds.kinds(), std::vector<SceneObject>(placed->objects));
  const Difference found =
      measure("airfield", {view_from(GetParam(), 18520.0, 3000.0, 1241.0), terrain::flat(kGround_m), scene}, 480);
  // A wall perpendicular to the line of sight returns tens of times as much as other walls. Its return depends on
  // the number of grid points that it crosses.
  EXPECT_NEAR(found.power, 0.0, 0.04);
  EXPECT_LT(found.shadow, 0.01);
  EXPECT_LT(found.rms_db, 1.2);
}

// A land gamma of -150 dB makes the ground dark, so that only the box returns.
TEST(Reference, ReturnsGammaTimesTheAreaOfABoxThatFacesTheRadar) {
  radar::RadarConfiguration configuration = bare_map(192);
  configuration.receiver.land_gamma_db = -150.0;
  configuration.fidelity.algorithm = radar::Algorithm::reference;
  Viewpoint view;
  const Box box{10.0, -20.0, 210.0, 60.0, 40.0, 25.0, kEarthenWorks};
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  scene->add(box);
  const auto process = make_patch(configuration, order_from(view), ground_of(terrain::flat(kGround_m)), scene);
  const double slant_m = std::hypot(view.distance_m, view.above_m);
  const double turn_rad = 30.0 * geo::kRadiansPerDegree;
  const double walls_m2 =
      box.height_m * (box.width_m * std::cos(turn_rad) + box.length_m * std::sin(turn_rad)) * view.distance_m / slant_m;
  const double wanted_m2 =
      gamma_of(configuration, kEarthenWorks) * (walls_m2 + box.length_m * box.width_m * view.above_m / slant_m);
  EXPECT_NEAR(cross_section_m2(process), wanted_m2, 0.005 * wanted_m2);
}

}  // namespace
}  // namespace yars::test
