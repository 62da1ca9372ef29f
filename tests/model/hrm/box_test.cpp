// Box and fence on level ground of a patch map: ends of shadow and layover, and radar cross section.
// Source: docs/spec/physics.md#layover.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

struct Case {
  double from_deg;    // true bearing from the box to the aircraft
  double distance_m;  // over ground
  double above_m;     // height of the aircraft above the ground
};

// Distance [m] of a row's middle from the map's centre, positive away from the aircraft.
double up_of(const hrm::PatchFormation& process, int row) {
  const double pixel_m = process.geometry().window_m() / process.image().size;
  return 0.5 * process.geometry().window_m() - (row + 0.5) * pixel_m;
}

class BoxSeen : public testing::TestWithParam<Case> {};

TEST_P(BoxSeen, CastsAShadowOfItsHeightOverTheTangentAndIsLaidOverByItsHeightTimesTheTangent) {
  const Case seen = GetParam();
  const radar::RadarConfiguration configuration = bare_map();
  Viewpoint view;
  view.from_deg = seen.from_deg;
  view.distance_m = seen.distance_m;
  view.above_m = seen.above_m;
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  const Box box{0.0, 0.0, seen.from_deg, 60.0, 40.0, 25.0, kEarthenWorks};
  scene->add(box);
  const auto process = make_patch(configuration, order_from(view), ground_of(model::terrain::flat(kGround_m)), scene);
  const hrm::MapImage& image = process.image();
  const double pixel_m = process.geometry().window_m() / image.size;
  const double ground = gamma_of(configuration, 0);
  const double roof = gamma_of(configuration, kEarthenWorks);
  const double tangent = seen.above_m / seen.distance_m;
  // A wall of height h shows h cos(psi) to the radar and is laid over on h tan(psi) of ground. Level ground of this
  // length shows h tan(psi) sin(psi). The ratio is 1 / tan^2(psi).
  const double wall = roof / (tangent * tangent);
  int shadow_end = -1;  // row 0 is far
  int roof_end = -1;
  int layover_begin = -1;
  const int middle = image.size / 2;
  for (int row = 0; row < image.size; ++row) {
    const double power = static_cast<double>(image.power[image.at(middle, row)]);
    if (power < 0.5 * ground && shadow_end < 0) shadow_end = row;
    if (power > 0.5 * roof && shadow_end >= 0 && roof_end < 0) roof_end = row;
    if (power > ground + 0.5 * (wall + roof)) layover_begin = row;
  }
  const double back_m = 0.5 * box.length_m;
  // Where the ray over the far edge of the roof meets the ground again.
  const double over_m = seen.distance_m + back_m;
  const double meets_m = over_m * seen.above_m / (seen.above_m - box.height_m);
  EXPECT_NEAR(up_of(process, shadow_end) + 0.5 * pixel_m, meets_m - seen.distance_m, pixel_m);
  const auto laid_over_m = [&](double distance_m) {
    return hrm::laid_over_m(distance_m, box.height_m, seen.above_m) - seen.distance_m;
  };
  EXPECT_NEAR(up_of(process, roof_end) + 0.5 * pixel_m, laid_over_m(over_m), pixel_m);
  const double front_m = laid_over_m(seen.distance_m - back_m);
  EXPECT_NEAR(up_of(process, layover_begin) - 0.5 * pixel_m, front_m, pixel_m);
  // First order: shadow h / tan(psi), layover h tan(psi).
  EXPECT_NEAR(meets_m - over_m, box.height_m / tangent, 0.02 * box.height_m / tangent + 0.5 * pixel_m);
  EXPECT_NEAR(-back_m - front_m, box.height_m * tangent, 0.5 * pixel_m);
}

TEST_P(BoxSeen, ReturnsGammaTimesTheAreaThatFacesTheRadar) {
  const Case seen = GetParam();
  radar::RadarConfiguration configuration = bare_map();
  configuration.receiver.land_gamma_db = -150.0;
  Viewpoint view;
  view.from_deg = seen.from_deg;
  view.distance_m = seen.distance_m;
  view.above_m = seen.above_m;
  for (const double turn_deg : {0.0, 30.0, 45.0}) {
    const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
    const Box box{10.0, -20.0, seen.from_deg + turn_deg, 60.0, 40.0, 25.0, kStone};
    scene->add(box);
    const auto process = make_patch(configuration, order_from(view), ground_of(model::terrain::flat(kGround_m)), scene);
    const double slant_m = std::hypot(seen.distance_m, seen.above_m);
    const double turn_rad = turn_deg * geo::kRadiansPerDegree;
    const model::physics::LandReturn land = model::physics::make_land_return(configuration);
    const auto wall = [&](double width_m, double off_deg) {
      const double cardinal = model::physics::cardinal_gain(land.cardinal[kStone], off_deg, land.cardinal_width_deg);
      return cardinal * width_m * box.height_m * std::cos(off_deg * geo::kRadiansPerDegree) * seen.distance_m / slant_m;
    };
    const double roof_m2 = box.length_m * box.width_m * seen.above_m / slant_m;
    const double side_m2 = turn_rad > 0.0 ? wall(box.length_m, 90.0 - turn_deg) : 0.0;
    const double expected_m2 = land.gamma[kStone] * (wall(box.width_m, turn_deg) + side_m2 + roof_m2);
    EXPECT_NEAR(cross_section_m2(process), expected_m2, 0.05 * expected_m2) << turn_deg;
  }
}

// A wall and the ground before it return as a dihedral while the wall faces the radar.
TEST(DoubleBounce, HasTheAspectOfTheCardinalEffect) {
  for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference}) {
    radar::RadarConfiguration configuration = bare_map(240);
    configuration.receiver.land_gamma_db = -150.0;
    configuration.fidelity.algorithm = algorithm;
    const Viewpoint view;
    const model::physics::LandReturn land = model::physics::make_land_return(configuration);
    const double cos_grazing = view.distance_m / std::hypot(view.distance_m, view.above_m);
    for (const double turn_deg : {0.0, 3.0, 6.0, 30.0}) {
      if (algorithm == radar::Algorithm::reference && (turn_deg == 3.0 || turn_deg == 30.0)) continue;  // takes long
      const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
      const Box box{0.0, 0.0, view.from_deg + turn_deg, 60.0, 40.0, 25.0, kStone};
      scene->add(box);
      const auto seen_m2 = [&](bool bounce) {
        configuration.fidelity.map_double_bounce = bounce;
        return cross_section_m2(
            make_patch(configuration, order_from(view), ground_of(model::terrain::flat(kGround_m)), scene));
      };
      const double effect =
          model::physics::cardinal_gain(land.cardinal[kStone], turn_deg, land.cardinal_width_deg) - 1.0;
      const double facing_m2 = box.width_m * box.height_m * std::cos(turn_deg * geo::kRadiansPerDegree) * cos_grazing;
      const double expected_m2 = model::physics::ratio(configuration.high_resolution.double_bounce_db) *
                                 land.gamma[kStone] * effect * facing_m2;
      const double largest_m2 = land.gamma[kStone] * land.cardinal[kStone] * facing_m2;
      EXPECT_NEAR(seen_m2(true) - seen_m2(false), expected_m2, 0.06 * expected_m2 + 0.001 * largest_m2) << turn_deg;
    }
  }
}

// A fence is a vertical face without a roof. It returns the area of its face and shadows the ground behind it.
TEST(Fence, ReturnsItsFaceAndCastsAShadowWithoutARoof) {
  radar::RadarConfiguration configuration = bare_map();
  configuration.receiver.land_gamma_db = -150.0;
  Viewpoint view;
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  // The aircraft is in the south. The fence has a quad for each side, as in models.
  scene->add_quad({{{-50, 0, 0}, {50, 0, 0}, {50, 0, 6}, {-50, 0, 6}}}, kEarthenWorks);
  scene->add_quad({{{50, 0, 0}, {-50, 0, 0}, {-50, 0, 6}, {50, 0, 6}}}, kEarthenWorks);
  const auto dark = make_patch(configuration, order_from(view), ground_of(model::terrain::flat(kGround_m)), scene);
  const double expected_m2 = gamma_of(configuration, kEarthenWorks) * 100.0 * 6.0 * view.distance_m /
                             std::hypot(view.distance_m, view.above_m);
  EXPECT_NEAR(cross_section_m2(dark), expected_m2, 0.02 * expected_m2);

  configuration.receiver.land_gamma_db = -10.0;
  const auto lit = make_patch(configuration, order_from(view), ground_of(model::terrain::flat(kGround_m)), scene);
  const double shadow_m = 6.0 * view.distance_m / view.above_m;
  const double pixel_m = lit.geometry().window_m() / lit.image().size;
  const int column = lit.image().size / 2;
  const auto half = static_cast<float>(0.5 * model::physics::ratio(-10.0));
  double dark_m = 0.0;
  for (int row = 0; row < lit.image().size; ++row)
    if (lit.image().power[lit.image().at(column, row)] < half) dark_m += pixel_m;
  EXPECT_NEAR(dark_m, shadow_m, pixel_m);
}

INSTANTIATE_TEST_SUITE_P(FromSeveralSides, BoxSeen,
                         testing::Values(Case{180.0, 20000.0, 3000.0}, Case{90.0, 37040.0, 4572.0},
                                         Case{0.0, 10000.0, 3640.0}, Case{237.0, 8000.0, 6000.0}));

}  // namespace
}  // namespace yars::test
