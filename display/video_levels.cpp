#include "display/video_levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace yars::display {

namespace {
constexpr float kNeutralContrast = 8.0F;
constexpr float kStepsToDouble = 4.0F;
constexpr float kMostBrightness = 15.0F;
constexpr float kBrightnessPower = 0.35F;  // the power-up brightness, 8, leaves 80 % of the light; the knob acts below
}  // namespace

std::array<float, 256> video_light(int brightness, int contrast) {
  const float slope = std::exp2((static_cast<float>(contrast) - kNeutralContrast) / kStepsToDouble);
  const float turned_up = std::clamp(static_cast<float>(brightness), 0.0F, kMostBrightness) / kMostBrightness;
  const float peak = std::pow(turned_up, kBrightnessPower);
  std::array<float, 256> light{};
  for (std::size_t video = 0; video < light.size(); ++video) {
    const float turned = std::clamp(0.5F + (static_cast<float>(video) / 255.0F - 0.5F) * slope, 0.0F, 1.0F);
    const float gray = std::min(std::floor(turned * kGrays), kGrays - 1.0F);
    light[video] = peak * gray / (kGrays - 1.0F);
  }
  return light;
}

}  // namespace yars::display
