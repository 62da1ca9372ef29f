#include "lib/radar/colors.hpp"

#include <algorithm>
#include <cmath>

namespace yars::radar {

ColorConfiguration color_preset(ColorPreset preset) {
  switch (preset) {
    case ColorPreset::gray:
      return {preset, {0.80, 0.80, 0.80}, {1.0, 1.0, 1.0}, {0.48, 0.48, 0.48}};
    case ColorPreset::night:
      return {preset, {0.46, 0.09, 0.05}, {0.72, 0.22, 0.14}, {0.34, 0.08, 0.05}};
    case ColorPreset::green:
      break;
  }
  return {};
}

Rgb rgb_from_hsv(double hue_deg, double saturation, double value) {
  // Each channel is full within 60 degrees of its own hue and falls to the saturation's floor 120 degrees away.
  const auto channel = [&](double own_hue_deg) {
    const double away = std::abs(std::remainder(hue_deg - own_hue_deg, 360.0)) / 60.0;
    return value * (1.0 - saturation * std::clamp(away - 1.0, 0.0, 1.0));
  };
  return {channel(0.0), channel(120.0), channel(240.0)};
}

}  // namespace yars::radar
