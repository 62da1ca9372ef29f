// Tests of patch maps on the display: position and brightness of their pixels, and which map is shown.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "display/gl/context.hpp"
#include "display/gl/display.hpp"
#include "display/symbology/radar_video.hpp"
#include "lib/radar/configuration.hpp"
#include "tests/display/gl/made_up_map.hpp"
#include "tests/display/gl/made_up_sweeps.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display::gl {
namespace {

class MapPictures : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = open_headless();
    if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
    context_ = std::move(*context);
  }

  // Input of a patch map without legends and symbols, except the fixed scales. These leave the middle free.
  static DisplayInput bare_patch(std::uint32_t size = 480) {
    DisplayInput input = testing::operating(radar::Mode::patch, 40.0);
    for (auto& legend : input.state.legends) legend[0] = '\0';
    input.state.brightness = 15;
    testing::put_map(input, 60.0, 20.0, 4.7);
    input.map.size = size;
    return input;
  }
  static Display display_of(int size) {
    return Display(radar::RadarConfiguration(), size, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  }

  static void show(DisplayInput& input, std::uint64_t id) { input.map.id = input.state.map_shown = id; }

  std::unique_ptr<Context> context_;
};

int red(const imageio::Image& image, int x, int y) {
  return image
      .pixels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 3];
}

int red_in_the_middle(const Display& radar_display) {
  const imageio::Image image = radar_display.read();
  return red(image, image.width / 2, image.height * 9 / 20);  // clear of the range arcs
}

// Pixels of a map of one brightness.
std::vector<std::uint8_t> tone(std::uint8_t level, std::uint32_t size = 480) {
  return std::vector<std::uint8_t>(std::size_t{size} * size, level);
}

TEST_F(MapPictures, AMapOfTheDisplaysSizeIsDrawnPixelByPixelWithVideoLight) {
  for (const int size : {480, 1024}) {
    DisplayInput input = bare_patch(static_cast<std::uint32_t>(size));
    input.state.brightness = 11;
    input.state.contrast = 10;
    const auto pixels = testing::made_up_ground(size);
    const auto light = video_light(11, 10);
    Display radar_display = display_of(size);
    radar_display.add(input.map, pixels);
    ASSERT_TRUE(radar_display.draw(input));
    const imageio::Image image = radar_display.read();
    for (int y = size / 10; y < size * 8 / 10; ++y) {
      for (int x = size / 4; x < size * 9 / 10; ++x) {
        const std::uint8_t level =
            pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
        ASSERT_NEAR(red(image, x, y), 255.0F * light[level], 0.6) << x << ' ' << y << " at " << size;
      }
    }
  }
}

TEST_F(MapPictures, AFinerMapIsAveraged) {
  DisplayInput input = bare_patch(960);
  std::vector<std::uint8_t> pixels = tone(0, 960);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = (i + i / 960) % 2 == 0 ? 255 : 0;
  Display radar_display = display_of(480);
  radar_display.add(input.map, pixels);
  radar_display.draw(input);
  const imageio::Image image = radar_display.read();
  const auto half = static_cast<int>(255.0F * video_light(15, 8)[128]);
  for (int x = 150; x < 400; ++x) EXPECT_NEAR(red(image, x, 200), half, 40) << "a checkerboard is gray, " << x;
}

TEST_F(MapPictures, TheMapFillsTheDisplayToItsEdges) {
  DisplayInput input = bare_patch();
  Display radar_display = display_of(600);
  radar_display.add(input.map, tone(255));
  radar_display.draw(input);
  const imageio::Image image = radar_display.read();
  for (const int edge : {0, 599}) {
    EXPECT_EQ(red(image, edge, 300), 255);
    EXPECT_EQ(red(image, 300, edge), 255);
  }
}

TEST_F(MapPictures, AFlipShowsTheOtherMapWithoutAddingItAgain) {
  DisplayInput input = bare_patch();
  Display radar_display = display_of(480);
  input.state.map_old = 2;
  radar_display.add(input.map, tone(255));
  show(input, 2);
  radar_display.add(input.map, tone(0));
  for (int flip = 0; flip < 3; ++flip) {
    show(input, 1);
    EXPECT_TRUE(radar_display.draw(input));
    EXPECT_EQ(red_in_the_middle(radar_display), 255);
    EXPECT_FALSE(radar_display.draw(input));
    show(input, 2);
    EXPECT_TRUE(radar_display.draw(input));
    EXPECT_EQ(red_in_the_middle(radar_display), 0);
  }
}

TEST_F(MapPictures, AMapThatTheStateNoLongerNamesIsReleased) {
  DisplayInput input = bare_patch();
  Display radar_display = display_of(480);
  radar_display.add(input.map, tone(255));
  radar_display.draw(input);
  input.state.map_newest = 2;
  show(input, 2);
  radar_display.add(input.map, tone(255));
  radar_display.draw(input);
  input.state.map_newest = 1;
  show(input, 1);
  radar_display.draw(input);
  EXPECT_EQ(red_in_the_middle(radar_display), 0);
}

TEST_F(MapPictures, AMapIsShownOnlyInItsModesAndOnlyIfTheStateNamesOne) {
  DisplayInput input = bare_patch();
  Display radar_display = display_of(480);
  radar_display.add(input.map, tone(255));
  const auto lit_in = [&](radar::Mode mode, bool shown) {
    input.state.mode = static_cast<std::uint8_t>(mode);
    input.state.map_shown = shown ? 1 : 0;
    radar_display.draw(input);
    return red_in_the_middle(radar_display) == 255;
  };
  for (const auto mode : {radar::Mode::patch, radar::Mode::hrm, radar::Mode::air_to_air, radar::Mode::ranging})
    EXPECT_TRUE(lit_in(mode, true)) << radar::name_of(mode);
  for (const auto mode : {radar::Mode::rbm, radar::Mode::hrm, radar::Mode::beacon, radar::Mode::pvu,
                          radar::Mode::air_to_air, radar::Mode::menu})
    EXPECT_FALSE(lit_in(mode, false)) << radar::name_of(mode);
  EXPECT_FALSE(lit_in(radar::Mode::menu, true));
  input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
  EXPECT_FALSE(lit_in(radar::Mode::patch, true));
}

TEST_F(MapPictures, AfterAMapTheSweepsOfTheHrmPpiAreShownAgain) {
  DisplayInput input = bare_patch();
  Display radar_display = display_of(480);
  databuffer::Sweep sweep =
      testing::toned_sweep(testing::kAircraftPosition, 20.0, 40.0, 40.0 * geo::kMetresPerNauticalMile, 480, 255);
  sweep.mode = static_cast<std::uint8_t>(radar::Mode::hrm);
  radar_display.add(sweep);
  radar_display.add(input.map, tone(0));
  radar_display.draw(input);
  EXPECT_EQ(red_in_the_middle(radar_display), 0);
  input.state.mode = static_cast<std::uint8_t>(radar::Mode::hrm);
  input.state.map_shown = 0;
  radar_display.draw(input);
  EXPECT_EQ(red_in_the_middle(radar_display), 255);
}

}  // namespace
}  // namespace yars::display::gl
