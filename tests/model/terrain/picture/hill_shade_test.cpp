// The hill-shaded map of a view: sea, slopes towards the light and away from it, the part of the ground that is shown.
#include "model/terrain/picture/hill_shade.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/model/terrain/shapes.hpp"

namespace yars::model::terrain {
namespace {

using Pixel = std::array<int, 3>;

Pixel pixel_of(const imageio::Image& image, int x, int y) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}
int brightness(const Pixel& pixel) {
  return pixel[0] + pixel[1] + pixel[2];
}

// A ridge along the meridian of 122 degrees west, 1,000 m high, with slopes of 10 km; lowland of 50 m beside it.
double ridge_m(geo::GeoPoint point) {
  const double distance_m = std::abs(point.longitude_deg + 122.0) * 89'000.0;
  return std::max(50.0, 1000.0 * (1.0 - distance_m / 10'000.0));
}

TEST(HillShade, ASlopeTowardsTheLightInTheWestIsBrighterThanOneAwayFromIt) {
  const AnalyticTerrain view(ridge_m);
  const auto image = map_of(view, {36.9, 37.1, -122.2, -121.8, 100, 50});
  ASSERT_EQ(image.width, 100);
  ASSERT_EQ(image.height, 50);
  EXPECT_GT(brightness(pixel_of(image, 40, 25)), 1.2 * brightness(pixel_of(image, 60, 25)));
}

TEST(HillShade, LevelGroundHasOneColourAndTheSeaAnother) {
  const auto land = map_of(AnalyticTerrain(flat(100.0)), {36.9, 37.1, -122.2, -121.8, 32, 32});
  EXPECT_EQ(pixel_of(land, 0, 0), pixel_of(land, 31, 31));
  const auto sea = map_of(AnalyticTerrain(flat(0.0)), {36.9, 37.1, -122.2, -121.8, 32, 32});
  const Pixel blue = pixel_of(sea, 16, 16);
  EXPECT_GT(blue[2], blue[0] + 40);
  EXPECT_NE(pixel_of(land, 16, 16), blue);
}

TEST(HillShade, BeyondThePolesThereIsNothing) {
  const auto image = map_of(AnalyticTerrain(flat(100.0)), {88.0, 96.0, 0.0, 8.0, 64, 64});
  EXPECT_EQ(pixel_of(image, 10, 10), pixel_of(blank_map({88.0, 96.0, 0.0, 8.0, 64, 64}), 10, 10));
  EXPECT_NE(pixel_of(image, 10, 60), pixel_of(image, 10, 10));
}

}  // namespace
}  // namespace yars::model::terrain
