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

const std::string kEverySign = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.:/<>()?!=%^v";

TEST(StrokeFont, EverySignStaysInsideItsCapHeightAndWidth) {
  for (const char sign : kEverySign) {
    const std::string text(1, sign);
    ASSERT_FALSE(strokes_of(text).empty()) << sign;
    for (const auto& stroke : strokes_of(text)) {
      ASSERT_GE(stroke.size(), 2U) << sign;
      for (const Point& point : stroke) {
        EXPECT_GE(point.x, 0.0F) << sign;
        EXPECT_LE(point.x, text_width(text) + 1e-4F) << sign;
        EXPECT_LE(point.y, 0.0F) << sign;
        EXPECT_GE(point.y, -1.0F) << sign;
      }
    }
  }
}

TEST(StrokeFont, NoTwoSignsAreAlike) {
  for (std::size_t a = 0; a < kEverySign.size(); ++a) {
    for (std::size_t b = a + 1; b < kEverySign.size(); ++b) {
      EXPECT_NE(strokes_of(kEverySign.substr(a, 1)), strokes_of(kEverySign.substr(b, 1)))
          << kEverySign[a] << " and " << kEverySign[b];
    }
  }
}

TEST(StrokeFont, CapitalsReachFromTheBaseLineToTheCapHeight) {
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

TEST(StrokeFont, SmallLettersReadAsCapitalsButVIsAnArrow) {
  EXPECT_EQ(strokes_of("gain"), strokes_of("GAIN"));
  EXPECT_NE(strokes_of("v"), strokes_of("V"));
}

TEST(StrokeFont, TheDegreeSignIsOneCharacterOfUtf8) {
  EXPECT_EQ(strokes_of("\u00b0").size(), 1U);
  EXPECT_NE(strokes_of("\u00b0"), strokes_of("~"));
}

TEST(StrokeFont, AnUnknownCharacterIsABoxAndATornUtf8SequenceIsNoMore) {
  const Strokes box = strokes_of("~");
  ASSERT_EQ(box.size(), 1U);
  EXPECT_EQ(box[0].size(), 5U);
  EXPECT_EQ(box[0].front(), box[0].back());
  EXPECT_EQ(strokes_of("\xc2"), box);
  EXPECT_EQ(strokes_of("\xff"), box);
}

TEST(StrokeFont, TheWidthOfATextIsThatOfItsInk) {
  EXPECT_FLOAT_EQ(text_width(""), 0.0F);
  float right = 0.0F;
  for (const auto& stroke : strokes_of("NH")) {
    for (const Point& point : stroke) right = std::max(right, point.x);
  }
  EXPECT_FLOAT_EQ(text_width("NH"), right);
}

}  // namespace
}  // namespace yars::display
