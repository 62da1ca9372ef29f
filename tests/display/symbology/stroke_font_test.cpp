// Vector font of the display. Units: cap heights, y down, origin at the left end of the base line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "display/symbology/draw_list.hpp"

namespace yars::display {
namespace {

using Strokes = std::vector<std::vector<Point>>;

class Collected final : public StrokeSink {
 public:
  void polyline(std::span<const Point> points) override { strokes.emplace_back(points.begin(), points.end()); }
  Strokes strokes;
};

Strokes strokes_of(std::string_view text) {
  Collected collected;
  stroke_text(text, collected);
  return collected.strokes;
}

const std::string kAllCharacters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.:/<>()?!=%^v";

TEST(StrokeFont, EveryCharacterStaysInsideItsCapHeightAndWidth) {
  for (const char character : kAllCharacters) {
    const std::string text(1, character);
    ASSERT_FALSE(strokes_of(text).empty()) << character;
    for (const auto& stroke : strokes_of(text)) {
      ASSERT_GE(stroke.size(), 2U) << character;
      for (const Point& point : stroke) {
        EXPECT_GE(point.x, 0.0F) << character;
        EXPECT_LE(point.x, text_width(text) + 1e-4F) << character;
        EXPECT_LE(point.y, 0.0F) << character;
        EXPECT_GE(point.y, -1.0F) << character;
      }
    }
  }
}

TEST(StrokeFont, NoTwoCharactersAreEqual) {
  for (std::size_t a = 0; a < kAllCharacters.size(); ++a) {
    for (std::size_t b = a + 1; b < kAllCharacters.size(); ++b) {
      EXPECT_NE(strokes_of(kAllCharacters.substr(a, 1)), strokes_of(kAllCharacters.substr(b, 1)))
          << kAllCharacters[a] << " and " << kAllCharacters[b];
    }
  }
}

TEST(StrokeFont, ACapitalExtendsFromTheBaseLineToTheCapHeight) {
  float top = 0.0F;
  float bottom = -1.0F;
  for (const auto& stroke : strokes_of("H")) {
    for (const Point& point : stroke) {
      top = std::min(top, point.y);
      bottom = std::max(bottom, point.y);
    }
  }
  EXPECT_FLOAT_EQ(top, -1.0F);
  EXPECT_FLOAT_EQ(bottom, 0.0F);
}

// The lowest point of a text, below the base line above 0.
float lowest_of(std::string_view text) {
  float lowest = -1.0F;
  for (const auto& stroke : strokes_of(text))
    for (const Point& point : stroke) lowest = std::max(lowest, point.y);
  return lowest;
}

TEST(StrokeFont, AFullStopEndsOnTheBaseLineACommaAndASemicolonFarBelowIt) {
  EXPECT_FLOAT_EQ(lowest_of("."), 0.0F);
  for (const char* text : {",", ";"}) {
    EXPECT_GE(lowest_of(text), 0.2F) << text;
    EXPECT_LE(lowest_of(text), 0.3F) << text;
  }
}

TEST(StrokeFont, LowerCaseIsDrawnAsUpperCaseButVIsAnArrow) {
  EXPECT_EQ(strokes_of("gain"), strokes_of("GAIN"));
  EXPECT_NE(strokes_of("v"), strokes_of("V"));
}

TEST(StrokeFont, TheDegreeSignIsOneCharacterOfUtf8) {
  EXPECT_EQ(strokes_of("\u00b0").size(), 1U);
  EXPECT_NE(strokes_of("\u00b0"), strokes_of("~"));
}

TEST(StrokeFont, AnUnknownCharacterAndAnIncompleteUtf8SequenceAreABox) {
  const Strokes box = strokes_of("~");
  ASSERT_EQ(box.size(), 1U);
  EXPECT_EQ(box[0].size(), 5U);
  EXPECT_EQ(box[0].front(), box[0].back());
  EXPECT_EQ(strokes_of("\xc2"), box);
  EXPECT_EQ(strokes_of("\xff"), box);
}

TEST(StrokeFont, TheWidthOfATextEndsAtItsRightmostStroke) {
  EXPECT_FLOAT_EQ(text_width(""), 0.0F);
  float right = 0.0F;
  for (const auto& stroke : strokes_of("NH")) {
    for (const Point& point : stroke) right = std::max(right, point.x);
  }
  EXPECT_FLOAT_EQ(text_width("NH"), right);
}

}  // namespace
}  // namespace yars::display
