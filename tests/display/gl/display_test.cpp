// Tests of the drawn display: position and brightness of sweeps, symbols, colours, and when it is drawn again.
#include "display/gl/display.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "display/gl/context.hpp"
#include "lib/radar/configuration.hpp"
#include "tests/display/gl/made_up_sweeps.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display::gl {
namespace {

using testing::kAircraftPosition;

constexpr double kRange_m = 40.0 * geo::kMetresPerNauticalMile;
constexpr double kTrack_deg = 30.0;

// Fixture: OpenGL without a screen. The tests are skipped where EGL gives no context.
class DisplayPictures : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = open_headless();
    if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
    context_ = std::move(*context);
  }

  // Input of the real beam map without legends and symbols, except the fixed scales.
  static DisplayInput bare_input() {
    DisplayInput input = testing::operating(radar::Mode::rbm, 40.0);
    for (auto& legend : input.state.legends) legend[0] = '\0';
    input.state.brightness = 15;
    return input;
  }

  std::unique_ptr<Context> context_;
};

// Background black, video red, symbols green, lines blue.
ColorScheme test_colors() {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

std::array<int, 3> pixel(const imageio::Image& image, int x, int y) {
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 3;
  return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

// Centroid [pixels] and sum of the red light in a rectangle.
struct Spot {
  double x = 0.0, y = 0.0, light = 0.0;
};

Spot red_spot(const imageio::Image& image, const Rect& within) {
  Spot spot;
  for (int y = static_cast<int>(within.top); y < static_cast<int>(within.bottom); ++y) {
    for (int x = static_cast<int>(within.left); x < static_cast<int>(within.right); ++x) {
      const double red = pixel(image, x, y)[0];
      spot.x += red * (x + 0.5);
      spot.y += red * (y + 0.5);
      spot.light += red;
    }
  }
  if (spot.light > 0.0) {
    spot.x /= spot.light;
    spot.y /= spot.light;
  }
  return spot;
}

Rect above_gray_scale(int size) {
  // The display's upper 70 %: without the gray scale, which is red too.
  const auto edge = static_cast<float>(size);
  return {0.0F, 0.0F, edge, edge * 0.7F};
}

TEST_F(DisplayPictures, ASingleBrightSampleIsDrawnAtItsRangeAndAzimuth) {
  for (const int size : {480, 1024}) {
    Display radar_display(radar::RadarConfiguration(), size, test_colors());
    for (const double right_deg : {-27.0, -8.0, 14.0, 31.0}) {
      for (const int sample : {150, 290, 400}) {
        databuffer::Sweep sweep = testing::blank_sweep(kAircraftPosition, kTrack_deg + right_deg - 0.3,
                                                       kTrack_deg + right_deg + 0.3, kRange_m, 480);
        sweep.video[sample] = 255;
        sweep.mode = 0;
        radar_display.add(sweep);
        ASSERT_TRUE(radar_display.draw(bare_input()));
        const Spot spot = red_spot(radar_display.read(), above_gray_scale(size));
        const double scale = size / 480.0;
        const double radius = 400.0 * (sample + 0.5) / 480.0;
        const double angle = right_deg * geo::kRadiansPerDegree;
        EXPECT_GT(spot.light, 0.0);
        EXPECT_NEAR(spot.x, scale * (240.0 + radius * std::sin(angle)), 1.0)
            << size << ' ' << right_deg << ' ' << sample;
        EXPECT_NEAR(spot.y, scale * (440.0 - radius * std::cos(angle)), 1.0)
            << size << ' ' << right_deg << ' ' << sample;
      }
      radar_display = Display(radar::RadarConfiguration(), size, test_colors());
    }
  }
}

TEST_F(DisplayPictures, NeighbouringWedgesLeaveNoGaps) {
  Display radar_display(radar::RadarConfiguration(), 480, test_colors());
  for (int i = 0; i < 160; ++i) {
    // Between sweeps the aircraft flies 1.5 m.
    const geo::GeoPoint apex = testing::at(kTrack_deg, -0.15 + i * 0.0008);
    const double left_deg = kTrack_deg - 40.0 + i * 0.5;
    radar_display.add(testing::toned_sweep(apex, left_deg, left_deg + 0.5, kRange_m, 480, 255));
  }
  radar_display.draw(bare_input());
  const imageio::Image image = radar_display.read();
  for (double right_deg = -38.0; right_deg <= 38.0; right_deg += 0.1) {
    for (double radius = 20.0; radius < 395.0; radius += 0.9) {
      const double angle = right_deg * geo::kRadiansPerDegree;
      const int x = static_cast<int>(240.0 + radius * std::sin(angle));
      const int y = static_cast<int>(440.0 - radius * std::cos(angle));
      if (x < 108 || x > 440 || y > 423) continue;  // elevation scale, range and azimuth caret, on black
      const auto color = pixel(image, x, y);
      EXPECT_TRUE(color[0] == 255 || color[1] + color[2] > 0) << x << ' ' << y;
    }
  }
}

// 714 sweeps in 18 s at the shortest range. Meanwhile the aircraft flies 4.5 km.
TEST_F(DisplayPictures, TheNarrowWedgesOfTheHrmPpiLeaveNoGaps) {
  constexpr double kShort_nm = 4.7;
  for (const int size : {480, 1024}) {
    Display radar_display(radar::RadarConfiguration(), size, test_colors());
    for (int i = 0; i < 714; ++i) {
      const geo::GeoPoint apex = testing::at(kTrack_deg, (i - 713) * 18.0 / 714 * 250.0 / geo::kMetresPerNauticalMile);
      const double left_deg = kTrack_deg - 50.0 + i * 0.14;
      databuffer::Sweep sweep =
          testing::toned_sweep(apex, left_deg, left_deg + 0.14, kShort_nm * geo::kMetresPerNauticalMile, 480, 255);
      sweep.mode = static_cast<std::uint8_t>(radar::Mode::hrm);
      radar_display.add(sweep);
    }
    DisplayInput input = bare_input();
    input.state.mode = static_cast<std::uint8_t>(radar::Mode::hrm);
    input.state.range_nm = kShort_nm;
    radar_display.draw(input);
    const imageio::Image image = radar_display.read();
    // In each row, no pixel between the first and the last lit one is dark.
    int dark = 0;
    for (int y = size * 6 / 10; y < size * 8 / 10; ++y) {
      int first = size, last = 0;
      for (int x = size * 25 / 100; x < size * 85 / 100; ++x) {
        if (pixel(image, x, y)[0] != 255) continue;
        first = std::min(first, x);
        last = std::max(last, x);
      }
      EXPECT_LT(first, last);
      for (int x = first; x < last; ++x) {
        const auto color = pixel(image, x, y);
        dark += color[0] == 255 || color[1] + color[2] > 0 ? 0 : 1;
      }
    }
    EXPECT_EQ(dark, 0) << "at " << size;
  }
}

TEST_F(DisplayPictures, NothingIsDrawnBeyondTheSweepsRange) {
  Display radar_display(radar::RadarConfiguration(), 480, test_colors());
  radar_display.add(testing::toned_sweep(kAircraftPosition, 10.0, 25.0, kRange_m / 2.0, 480, 255));
  radar_display.draw(bare_input());
  const imageio::Image image = radar_display.read();
  const double angle = -12.5 * geo::kRadiansPerDegree;
  const auto red_at = [&](double radius) {
    return pixel(image, static_cast<int>(240.0 + radius * std::sin(angle)),
                 static_cast<int>(440.0 - radius * std::cos(angle)))[0];
  };
  EXPECT_EQ(red_at(197.0), 255);
  EXPECT_EQ(red_at(204.0), 0);
}

TEST_F(DisplayPictures, TheNewerSweepCoversTheOlder) {
  Display radar_display(radar::RadarConfiguration(), 480, test_colors());
  radar_display.add(testing::toned_sweep(kAircraftPosition, 10.0, 20.0, kRange_m, 480, 255));
  radar_display.add(
      testing::toned_sweep(kAircraftPosition, 17.0, 19.0, kRange_m, 480, 0));  // covers 18 deg, but not 13 deg
  radar_display.draw(bare_input());
  const imageio::Image image = radar_display.read();
  const auto red_at = [&](double bearing_deg) {
    const double angle = (bearing_deg - kTrack_deg) * geo::kRadiansPerDegree;
    return pixel(image, static_cast<int>(240.0 + 250.0 * std::sin(angle)),
                 static_cast<int>(440.0 - 250.0 * std::cos(angle)))[0];
  };
  EXPECT_EQ(red_at(13.0), 255);
  EXPECT_EQ(red_at(18.0), 0);
}

struct Sums {
  long video = 0, symbols = 0;
};

Sums sums_of(const imageio::Image& image) {
  Sums sums;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    sums.video += image.pixels[i];
    sums.symbols += image.pixels[i + 1];
  }
  return sums;
}

TEST_F(DisplayPictures, BrightnessAndContrastChangeOnlyTheVideo) {
  DisplayInput input = bare_input();
  Display radar_display(radar::RadarConfiguration(), 480, test_colors());
  radar_display.add(testing::toned_sweep(kAircraftPosition, 10.0, 50.0, kRange_m, 480, 70));
  input.state.brightness = 10;
  radar_display.draw(input);
  const Sums before = sums_of(radar_display.read());
  // The brightness level is drawn as a number. It stays equal here, so that all symbols stay equal.
  input.state.contrast = 4;
  ASSERT_TRUE(radar_display.draw(input));
  const Sums flatter = sums_of(radar_display.read());
  EXPECT_GT(flatter.video, before.video);
  EXPECT_EQ(flatter.symbols, before.symbols);
  input.state.contrast = 8;
  input.state.brightness = 0;
  radar_display.draw(input);
  const Sums dark = sums_of(radar_display.read());
  EXPECT_EQ(dark.video, 0);
  EXPECT_GT(dark.symbols, before.symbols * 9 / 10);
}

TEST_F(DisplayPictures, AnUnchangedDisplayIsNotDrawnAgain) {
  DisplayInput input = bare_input();
  Display radar_display(radar::RadarConfiguration(), 480);
  radar_display.add(testing::toned_sweep(kAircraftPosition, 10.0, 50.0, kRange_m, 480, 100));
  EXPECT_TRUE(radar_display.draw(input));
  EXPECT_FALSE(radar_display.draw(input));
  input.state.tick += 1;
  EXPECT_FALSE(radar_display.draw(input)) << "the tick is not drawn";
  radar_display.add(testing::toned_sweep(kAircraftPosition, 10.0, 50.0, kRange_m, 480, 90));
  EXPECT_TRUE(radar_display.draw(input));
  input.state.flags |= databuffer::kFreeze;
  EXPECT_TRUE(radar_display.draw(input));
  radar_display.resize(600);
  EXPECT_TRUE(radar_display.draw(input));
  EXPECT_EQ(radar_display.read().width, 600);
}

TEST_F(DisplayPictures, AFrozenDisplayStandsStillWhileTheAircraftFliesOn) {
  DisplayInput input = bare_input();
  input.model.flags = databuffer::kModelFrozen;
  Display radar_display(radar::RadarConfiguration(), 480);
  radar_display.add(testing::toned_sweep(kAircraftPosition, 10.0, 50.0, kRange_m, 480, 100));
  radar_display.draw(input);
  const auto before = radar_display.read().pixels;
  const geo::GeoPoint ahead = testing::at(kTrack_deg, 3.0);
  input.ownship.latitude_deg = input.nav.mission_latitude_deg = ahead.latitude_deg;
  input.ownship.longitude_deg = input.nav.mission_longitude_deg = ahead.longitude_deg;
  EXPECT_FALSE(radar_display.draw(input));
  input.model.flags = databuffer::kModelScanning;
  EXPECT_TRUE(radar_display.draw(input));
  EXPECT_NE(radar_display.read().pixels, before);
}

TEST_F(DisplayPictures, StandbyOffAndOtherModesShowNoVideo) {
  Display radar_display(radar::RadarConfiguration(), 480, test_colors());
  radar_display.add(testing::toned_sweep(kAircraftPosition, 10.0, 50.0, kRange_m, 480, 255));
  DisplayInput input = bare_input();
  radar_display.draw(input);
  EXPECT_GT(red_spot(radar_display.read(), above_gray_scale(480)).light, 0.0);
  input.state.mode = static_cast<std::uint8_t>(radar::Mode::hrm);
  radar_display.draw(input);
  EXPECT_EQ(red_spot(radar_display.read(), above_gray_scale(480)).light, 0.0);
  input.state.mode = static_cast<std::uint8_t>(radar::Mode::rbm);
  input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
  radar_display.draw(input);
  EXPECT_EQ(red_spot(radar_display.read(), above_gray_scale(480)).light, 0.0);
  input.state.power = static_cast<std::uint8_t>(radar::Power::off);
  radar_display.draw(input);
  const auto picture = radar_display.read();
  EXPECT_TRUE(std::ranges::all_of(picture.pixels, [](std::uint8_t value) { return value == 0; }));
}

TEST_F(DisplayPictures, TheGrayScaleShowsEightStepsFromDarkToBright) {
  Display radar_display(radar::RadarConfiguration(), 480, test_colors());
  radar_display.draw(bare_input());
  const imageio::Image image = radar_display.read();
  int last = -1;
  for (int gray = 0; gray < 8; ++gray) {
    const int red = pixel(image, 427, 419 - gray * 10)[0];
    EXPECT_GT(red, last) << gray;
    last = red;
  }
  EXPECT_EQ(last, 255);
}

TEST_F(DisplayPictures, AStrokeIsOpaqueInItsMiddleAndFadesAtItsEdge) {
  Display radar_display(radar::RadarConfiguration(), 960, test_colors());
  radar_display.draw(bare_input());
  const imageio::Image image = radar_display.read();
  // The azimuth scale's tick at -60 deg: x 120 units, 2.7 pixels wide.
  EXPECT_EQ(pixel(image, 240, 882)[1], 255);
  EXPECT_EQ(pixel(image, 239, 882)[1], 255);
  const int edge = pixel(image, 241, 882)[1];
  EXPECT_GT(edge, 0);
  EXPECT_LT(edge, 255);
  EXPECT_EQ(pixel(image, 243, 882)[1], 0);
}

std::array<int, 3> channels(const radar::Rgb& color) {
  const auto channel = [](double share) { return static_cast<int>(std::lround(share * 255.0)); };
  return {channel(color.red), channel(color.green), channel(color.blue)};
}

bool is_color(const std::array<int, 3>& found, const std::array<int, 3>& expected) {
  constexpr int kRounding = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(found[i] - expected[i]) > kRounding) return false;
  }
  return true;
}

int pixels_of(const imageio::Image& image, const radar::Rgb& color) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) count += is_color(pixel(image, x, y), channels(color)) ? 1 : 0;
  }
  return count;
}

TEST_F(DisplayPictures, UseTheColorsOfTheirScheme) {
  using radar::ColorPreset;
  for (const ColorPreset preset : {ColorPreset::green, ColorPreset::gray, ColorPreset::night}) {
    SCOPED_TRACE("preset " + std::to_string(static_cast<int>(preset)));
    radar::RadarConfiguration configuration;
    const radar::ColorConfiguration colors = radar::color_preset(preset);
    configuration.view.colors = colors;
    Display radar_display(configuration, 480);
    radar_display.add(
        testing::toned_sweep(kAircraftPosition, kTrack_deg + 10.0, kTrack_deg + 20.0, kRange_m, 480, 255));
    DisplayInput input = bare_input();
    radar_display.draw(input);
    const imageio::Image bright = radar_display.read();
    EXPECT_GT(pixels_of(bright, colors.video), 3000);
    EXPECT_GT(pixels_of(bright, colors.symbols), 30);
    EXPECT_GT(pixels_of(bright, colors.lines), 30);
    EXPECT_TRUE(is_color(pixel(bright, 5, 300), {0, 0, 0}));
    input.state.brightness = 0;
    radar_display.draw(input);
    const imageio::Image dark = radar_display.read();
    // The faded edges of gray symbols may have the gray of the video.
    EXPECT_LT(pixels_of(dark, colors.video), 100);
    EXPECT_GT(pixels_of(dark, colors.symbols), 30);
  }
}

}  // namespace
}  // namespace yars::display::gl
