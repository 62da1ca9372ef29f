// Attenuation of patch maps by the gases of the air, against sums over thin layers. Source: ITU-R P.676.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "lib/radar/configuration.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/physics/gas_layers.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

constexpr double kStep_m = 1500.0;  // height of the plateau behind the centre

hrm::PatchFormation map_of(radar::RadarConfiguration configuration, bool gases, const hrm::PatchOrder& order,
                           const model::terrain::TerrainViewPointer& ground,
                           const model::scene::SceneViewPointer& scene = nullptr) {
  configuration.world.atmosphere.gases = gases;
  return make_patch(configuration, order, ground, scene);
}

double decibels(float attenuated, float clear) {
  return 10.0 * std::log10(static_cast<double>(attenuated) / static_cast<double>(clear));
}

radar::RadarConfiguration round_earth(radar::Algorithm algorithm, int size) {
  radar::RadarConfiguration configuration = bare_map(size);
  configuration.fidelity.earth = radar::EarthModel::ellipsoid;
  configuration.fidelity.algorithm = algorithm;
  configuration.fidelity.map_layover = false;  // objects appear at their true positions
  return configuration;
}

// Level ground before the centre of the window, a plateau behind it.
class PatchGasesOver : public ::testing::TestWithParam<std::tuple<radar::Algorithm, double>> {};
INSTANTIATE_TEST_SUITE_P(PatchGases, PatchGasesOver,
                         ::testing::Combine(::testing::Values(radar::Algorithm::standard, radar::Algorithm::reference),
                                            ::testing::Values(4.7, 40.0)));

TEST_P(PatchGasesOver, AttenuateGroundAtAnyHeightByTheirIntegral) {
  const auto [algorithm, window_nm] = GetParam();
  const radar::RadarConfiguration configuration = round_earth(algorithm, 48);
  Viewpoint view;
  view.distance_m = 120000.0;
  view.above_m = 6000.0;
  view.window_m = window_nm * geo::kMetresPerNauticalMile;
  const hrm::PatchOrder order = order_from(view);
  const hrm::PatchGeometry geometry(order, configuration, kGround_m);
  const auto ground = ground_of([&](geo::GeoPoint position) {
    const hrm::MapPoint point = geometry.point_of(position);
    return std::hypot(point.right_m, point.up_m + view.distance_m) > view.distance_m + 1.0 ? kGround_m + kStep_m
                                                                                           : kGround_m;
  });
  const auto attenuated = map_of(configuration, true, order, ground),
             clear = map_of(configuration, false, order, ground);
  const hrm::MapImage& image = clear.image();
  const double pixel_m = view.window_m / image.size;
  int compared = 0;
  for (int row = 1; row < image.size; row += 4)
    for (int column = 1; column < image.size; column += 9) {
      const std::size_t at = image.at(column, row);
      const double up_m = 0.5 * view.window_m - (row + 0.5) * pixel_m;
      const double right_m = (column + 0.5) * pixel_m - 0.5 * view.window_m;
      const double distance_m = std::hypot(right_m, up_m + view.distance_m);
      const double beyond_m = distance_m - view.distance_m;
      if (std::abs(beyond_m) < 3.0 * pixel_m || !(image.power[at] > 0.0F)) continue;
      const double height_m = beyond_m > 0.0 ? kGround_m + kStep_m : kGround_m;
      const double expected_db = -2.0 * gases_in_layers_db(configuration, geometry.earth().radius_m(),
                                                           kGround_m + view.above_m, distance_m, height_m);
      EXPECT_NEAR(decibels(attenuated.image().power[at], image.power[at]), expected_db, 0.1)
          << window_nm << " NM, " << beyond_m << " m beyond the centre";
      ++compared;
    }
  EXPECT_GT(compared, 30);
}

// Only the faces of a tall block return; the land gamma of -120 dB makes the ground dark.
TEST(PatchGases, AttenuateObjectsOfTheSceneByTheirIntegral) {
  for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference}) {
    radar::RadarConfiguration configuration = round_earth(algorithm, 96);
    configuration.receiver.land_gamma_db = -120.0;
    Viewpoint view;
    view.distance_m = 60000.0;
    view.above_m = 6000.0;
    const hrm::PatchOrder order = order_from(view);
    const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
    scene->add({0.0, 0.0, 20.0, 200.0, 200.0, 150.0, kEarthenWorks});
    const auto ground = ground_of(model::terrain::flat(kGround_m));
    const double ratio = cross_section_m2(map_of(configuration, true, order, ground, scene)) /
                         cross_section_m2(map_of(configuration, false, order, ground, scene));
    const hrm::PatchGeometry geometry(order, configuration, kGround_m);
    EXPECT_NEAR(10.0 * std::log10(ratio),
                -2.0 * gases_in_layers_db(configuration, geometry.earth().radius_m(), kGround_m + view.above_m,
                                          view.distance_m, kGround_m + 75.0),
                0.1);
  }
}

// A mover loses as much as the ground at its position.
TEST(PatchGases, AttenuateMoversByTheirIntegral) {
  radar::RadarConfiguration configuration = round_earth(radar::Algorithm::standard, 96);
  configuration.receiver.land_gamma_db = -120.0;
  Viewpoint view;
  view.distance_m = 60000.0;
  view.above_m = 6000.0;
  const hrm::PatchOrder order = order_from(view);
  configuration.world.movers.push_back({"corner", kTarget, 0.0, 0.0, 1000.0, 0.0});
  const auto ground = ground_of(model::terrain::flat(kGround_m));
  const hrm::PatchGeometry geometry(order, configuration, kGround_m);
  EXPECT_NEAR(10.0 * std::log10(cross_section_m2(map_of(configuration, true, order, ground)) / 1000.0),
              -2.0 * gases_in_layers_db(configuration, geometry.earth().radius_m(), kGround_m + view.above_m,
                                        view.distance_m, kGround_m),
              0.1);
}

}  // namespace
}  // namespace yars::test
