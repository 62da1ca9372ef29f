// Near margin of the polar grid: the distance before the window that it covers, for towers that shadow the window.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

constexpr Box kTower{0.0, 0.0, 0.0, 20.0, 20.0, 40.0, kEarthenWorks};

// Scene with one tower at a position on the map.
std::shared_ptr<MadeUpScene> tower_at(const hrm::PatchGeometry& geometry, hrm::MapPoint position) {
  const auto scene = std::make_shared<MadeUpScene>(geometry.position_of(position), kGround_m);
  scene->add(kTower);
  return scene;
}

double near_margin_m(const hrm::PatchGeometry& geometry, hrm::MapPoint position) {
  std::vector<const model::scene::Tile*> tiles;
  const auto scene = tower_at(geometry, position);
  scene->tiles_near(kTarget, 0.0, tiles);
  return hrm::polar_margins(geometry, *ground_of(model::terrain::flat(kGround_m)), tiles, {}).near_m;
}

class Margins : public testing::Test {
 protected:
  Viewpoint view_;
  hrm::PatchGeometry geometry_{order_from(view_), bare_map(), kGround_m};
  double half_m_ = 0.5 * view_.window_m;
  double shadow_m_ = kTower.height_m * view_.distance_m / view_.above_m;
  double reach_m_ = std::hypot(0.5 * kTower.length_m, 0.5 * kTower.width_m);  // radius of the tile about its origin
};

TEST_F(Margins, AreZeroForATowerInTheWindow) {
  EXPECT_EQ(near_margin_m(geometry_, {0.0, 0.0}), 0.0);
  EXPECT_EQ(near_margin_m(geometry_, {100.0, -half_m_ + reach_m_ + 1.0}), 0.0);
}

TEST_F(Margins, CoverATowerWhoseShadowReachesTheWindow) {
  for (const double before_m : {10.0, 100.0, 200.0})
    EXPECT_NEAR(near_margin_m(geometry_, {0.0, -half_m_ - before_m}), before_m + reach_m_, 0.5) << before_m;
  EXPECT_NEAR(near_margin_m(geometry_, {0.0, -half_m_ - shadow_m_ - 5.0}), shadow_m_, 0.01 * shadow_m_);
}

TEST_F(Margins, AreZeroForAShadowThatEndsBeforeTheWindowOrLiesBesideIt) {
  EXPECT_EQ(near_margin_m(geometry_, {0.0, -half_m_ - 1.05 * shadow_m_ - reach_m_}), 0.0);
  EXPECT_EQ(near_margin_m(geometry_, {half_m_ + reach_m_ + 1.0, -half_m_ - 50.0}), 0.0);
}

TEST_F(Margins, LetTheShadowOfATowerBeforeTheWindowFallOntoIt) {
  const radar::RadarConfiguration configuration = bare_map();
  constexpr double kBefore_m = 150.0;
  const auto process = make_patch(configuration, order_from(view_), ground_of(model::terrain::flat(kGround_m)),
                                  tower_at(geometry_, {0.0, -half_m_ - kBefore_m}));
  const hrm::MapImage& image = process.image();
  const double pixel_m = view_.window_m / image.size;
  const auto half = static_cast<float>(0.5 * gamma_of(configuration, 0));
  double dark_m = 0.0;
  for (int row = 0; row < image.size; ++row)
    if (image.power[image.at(image.size / 2, row)] < half) dark_m += pixel_m;
  // The shadow ends where the ray over the far edge of the roof meets the ground.
  const double over_m = view_.distance_m - half_m_ - kBefore_m + 0.5 * kTower.length_m;
  const double meets_m = over_m * view_.above_m / (view_.above_m - kTower.height_m);
  EXPECT_NEAR(dark_m, meets_m - (view_.distance_m - half_m_), 2.0 * pixel_m);
}

}  // namespace
}  // namespace yars::test
