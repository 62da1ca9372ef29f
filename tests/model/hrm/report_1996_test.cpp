// Patch maps by the preset 1996: brightness is a dot product, objects are at true positions, noise is within 10 %.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/radar/configuration.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

namespace terrain = model::terrain;

radar::RadarConfiguration map_of_1996(int size = 240) {
  radar::RadarConfiguration configuration;
  configuration.fidelity = *radar::fidelity_preset("1996");
  configuration.fidelity.map_size = size;
  return configuration;
}

double middle_of(const hrm::MapImage& image) {
  return static_cast<double>(image.power[image.at(image.size / 2, image.size / 2)]);
}

struct Slope {
  double from_deg;    // true bearing from the target to the radar
  double climbs_deg;  // true bearing in which the plane rises
  double rise;        // height by distance
};

class Brightness : public ::testing::TestWithParam<Slope> {};

TEST_P(Brightness, OfATiltedPlaneIsItsNormalTimesTheDirectionToTheRadar) {
  const Slope slope = GetParam();
  Viewpoint view;
  view.from_deg = slope.from_deg;
  const auto plane = terrain::plane({kTarget, geo::Bearing::degrees(slope.climbs_deg)}, kGround_m, slope.rise);
  const auto process = make_patch(map_of_1996(), order_from(view), ground_of(plane));
  const double slant_m = std::hypot(view.distance_m, view.above_m);
  const double turn_rad = (slope.climbs_deg - slope.from_deg) * geo::kRadiansPerDegree;
  // The horizontal component of the normal points opposite to climbs_deg.
  const double dot = (-slope.rise * std::cos(turn_rad) * view.distance_m + view.above_m) /
                     (slant_m * std::sqrt(1.0 + slope.rise * slope.rise));
  EXPECT_NEAR(middle_of(process.image()), std::max(dot, 0.0), 0.002);
}
INSTANTIATE_TEST_SUITE_P(Planes, Brightness,
                         ::testing::Values(Slope{180, 0, 0.0}, Slope{180, 0, 0.5}, Slope{180, 90, 0.5},
                                           Slope{40, 250, 0.3}, Slope{300, 100, 1.0}, Slope{0, 10, 0.1},
                                           Slope{0, 0, 0.5}));

// Brightness that gives white: 2.5 times that of level ground at the map's centre.
double full_scale(const Viewpoint& view) {
  return 2.5 * view.above_m / std::hypot(view.distance_m, view.above_m);
}

// At any distance level ground is neither black nor white on the display's eight grays, and the picture is about as
// light as one of the preset `standard`: 0.236 of full light.
TEST(Video1996, OfLevelGroundIsTwoFifthsOfWhiteAtAnyDistance) {
  for (const double distance_m : {9'000.0, 37'040.0, 150'000.0}) {
    Viewpoint view;
    view.distance_m = distance_m;
    const auto process = make_patch(map_of_1996(96), order_from(view), ground_of(terrain::flat(kGround_m)));
    double mean = 0.0;
    for (const std::uint8_t video : process.picture()) mean += video / static_cast<double>(process.picture().size());
    EXPECT_NEAR(mean, 255.0 / 2.5, 1.5) << distance_m;
  }
}

TEST(Video1996, OfAFacetThatFacesTheRadarIsWhiteAndOfAShadowBlack) {
  const auto facing = terrain::plane({kTarget, geo::Bearing::degrees(0.0)}, kGround_m, 1.0);
  const auto bright = make_patch(map_of_1996(96), order_from({}), ground_of(facing));
  for (const std::uint8_t video : bright.picture()) ASSERT_EQ(video, 255);
  const auto averted = terrain::plane({kTarget, geo::Bearing::degrees(180.0)}, kGround_m, 1.0);
  const auto dark = make_patch(map_of_1996(96), order_from({}), ground_of(averted));
  for (const std::uint8_t video : dark.picture()) ASSERT_EQ(video, 0);
}

// Video divided by noise-free video is evenly distributed between 0.9 and 1.1.
TEST(Noise1996, IsEvenlyDistributedWithinATenthOfTheBrightness) {
  const auto plane = terrain::flat(kGround_m);
  const auto process = make_patch(map_of_1996(), order_from({}), ground_of(plane));
  double sum = 0.0, squares = 0.0, least = 1.0, most = -1.0;
  for (std::size_t i = 0; i < process.picture().size(); ++i) {
    const double level = 255.0 / full_scale({}) * static_cast<double>(process.image().power[i]);
    const double random = static_cast<double>(process.picture()[i]) / level - 1.0;
    sum += random;
    squares += random * random;
    least = std::min(least, random);
    most = std::max(most, random);
  }
  const auto count = static_cast<double>(process.picture().size());
  EXPECT_NEAR(sum / count, 0.0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / count), 0.10 / std::sqrt(3.0), 0.001);
  EXPECT_NEAR(least, -0.10, 0.006);  // a video level is about 1/100
  EXPECT_NEAR(most, 0.10, 0.006);
}

TEST(Noise1996, IsOffAtZeroAndNeverDependsOnLooks) {
  const auto plane = terrain::flat(kGround_m);
  radar::RadarConfiguration configuration = map_of_1996(96);
  hrm::PatchOrder order = order_from({});
  const auto one = make_patch(configuration, order, ground_of(plane));
  order.looks = 3;
  EXPECT_EQ(make_patch(configuration, order, ground_of(plane)).picture(), one.picture());
  ++order.map;
  EXPECT_NE(make_patch(configuration, order, ground_of(plane)).picture(), one.picture());
  configuration.fidelity.map_noise = 0.0;
  const auto quiet = make_patch(configuration, order, ground_of(plane));
  for (std::size_t i = 0; i < quiet.picture().size(); ++i)
    ASSERT_NEAR(quiet.picture()[i], 255.0 / full_scale({}) * static_cast<double>(quiet.image().power[i]), 0.51);
}

// The radar is in the south. The wall is bright at its true position. Behind it lie the roof and then a shadow of
// length h / tan(psi).
TEST(Map1996, ABoxIsNotLaidOverAndCastsItsShadow) {
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  const Box box{0.0, 0.0, 90.0, 120.0, 60.0, 30.0, kStone};
  scene->add(box);
  const radar::RadarConfiguration configuration = map_of_1996(480);
  const Viewpoint view;
  const auto process = make_patch(configuration, order_from(view), ground_of(terrain::flat(kGround_m)), scene);
  const hrm::MapImage& image = process.image();
  const double pixel_m = view.window_m / image.size;
  const double level = view.above_m / std::hypot(view.distance_m, view.above_m);
  const auto brightness_at = [&](double up_m) {
    const int row = static_cast<int>(std::floor(0.5 * image.size - up_m / pixel_m));
    return static_cast<double>(image.power[image.at(image.size / 2, row)]);
  };
  const double foot_m = -0.5 * box.width_m;
  double brightest_m = 0.0, brightest = 0.0;
  for (double up_m = -200.0; up_m < 200.0; up_m += 0.5 * pixel_m) {
    if (brightness_at(up_m) <= brightest) continue;
    brightest = brightness_at(up_m);
    brightest_m = up_m;
  }
  EXPECT_NEAR(brightest_m, foot_m, 1.5 * pixel_m);
  EXPECT_GT(brightest, 0.7);
  EXPECT_NEAR(brightness_at(foot_m - 4.0 * pixel_m), level, 0.01);
  EXPECT_NEAR(brightness_at(0.0), level, 0.01);  // the roof is level too
  const double shadow_m = box.height_m * view.distance_m / view.above_m;
  EXPECT_EQ(brightness_at(-foot_m + 3.0 * pixel_m), 0.0);
  EXPECT_EQ(brightness_at(-foot_m + shadow_m - 3.0 * pixel_m), 0.0);
  EXPECT_NEAR(brightness_at(-foot_m + shadow_m + 3.0 * pixel_m), level, 0.01);
}

TEST(Map1996, HasEqualBitsForAnyNumberOfThreads) {
  const auto hills = terrain::sine_hills({kTarget, geo::Bearing::degrees(30.0)}, 60.0, 700.0);
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  scene->add({});
  const auto one = make_patch(map_of_1996(), order_from({}), ground_of(hills), scene, 1);
  const auto three = make_patch(map_of_1996(), order_from({}), ground_of(hills), scene, 3);
  EXPECT_EQ(one.picture(), three.picture());
  EXPECT_EQ(one.image().power, three.image().power);
}

}  // namespace
}  // namespace yars::test
