// Light of the 256 video levels by brightness and contrast.
#include <gtest/gtest.h>

#include <set>

#include "display/symbology/radar_video.hpp"

namespace yars::display {
namespace {

TEST(VideoLevels, NeutralContrastGivesEightEquallySpacedGrays) {
  const auto light = video_light(15, 8);
  EXPECT_EQ(std::set<float>(light.begin(), light.end()).size(), 8U);
  EXPECT_FLOAT_EQ(light[0], 0.0F);
  EXPECT_FLOAT_EQ(light[31], 0.0F);
  EXPECT_FLOAT_EQ(light[32], 1.0F / 7.0F);
  EXPECT_FLOAT_EQ(light[224], 1.0F);
  EXPECT_FLOAT_EQ(light[255], 1.0F);
}

TEST(VideoLevels, BrightnessZeroIsDarkAndEachStepIsBrighter) {
  for (const float light : video_light(0, 8)) EXPECT_FLOAT_EQ(light, 0.0F);
  for (int brightness = 1; brightness <= 15; ++brightness) {
    EXPECT_GT(video_light(brightness, 8)[255], video_light(brightness - 1, 8)[255]);
  }
}

TEST(VideoLevels, EveryBrightnessAboveZeroKeepsEightGrays) {
  for (int brightness = 1; brightness <= 15; ++brightness) {
    const auto light = video_light(brightness, 8);
    EXPECT_EQ(std::set<float>(light.begin(), light.end()).size(), 8U) << brightness;
  }
}

TEST(VideoLevels, HigherContrastDarkensBelowAndBrightensAboveTheMiddle) {
  const auto flat = video_light(15, 4);
  const auto steep = video_light(15, 12);
  EXPECT_GT(flat[80], steep[80]);
  EXPECT_LT(flat[176], steep[176]);
  EXPECT_FLOAT_EQ(flat[130], steep[130]);
}

TEST(VideoLevels, LightNeverDecreasesWithTheVideoLevel) {
  for (const int contrast : {0, 8, 15}) {
    const auto light = video_light(9, contrast);
    for (std::size_t i = 1; i < light.size(); ++i) EXPECT_GE(light[i], light[i - 1]) << contrast;
  }
}

}  // namespace
}  // namespace yars::display
