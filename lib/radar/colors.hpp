// Colours of the glass: what a configuration may choose. The ground is black, as on any tube.
#pragma once

#include <cstdint>

namespace yars::radar {

struct Rgb {
  double red = 0.0, green = 0.0, blue = 0.0;  // [1] 0 to 1, as the display takes them (sRGB)
};

enum class ColorPreset : std::uint8_t { green = 0, gray = 1, night = 2 };

struct ColorConfiguration {
  ColorPreset preset = ColorPreset::green;  // what the colours began as
  Rgb video{0.30, 0.95, 0.42};              // full light; grays are fractions of it
  Rgb symbols{0.72, 1.0, 0.76};             // stand out from the brightest video
  Rgb lines{0.22, 0.55, 0.28};              // arcs and lines below the symbols
};

// Green phosphor; neutral grays; a dim red that spares the eyes at night.
ColorConfiguration color_preset(ColorPreset preset);

// Hue [deg] 0 to 360, red at 0 and green at 120; saturation and value [1] 0 to 1.
Rgb rgb_from_hsv(double hue_deg, double saturation, double value);

}  // namespace yars::radar
