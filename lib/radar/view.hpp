// Configuration of the radar display: visible area, size, range arcs and colours.
// config/schema reads the values from GUF files.
// Units: as the suffix of each name says; colours are sRGB.
#pragma once

#include <cstdint>
#include <vector>

namespace yars::radar {

// Colour of the display in sRGB. The background is always black.
struct Rgb {
  double red = 0.0, green = 0.0, blue = 0.0;  // [1] 0 to 1
};

enum class ColorPreset : std::uint8_t { green = 0, gray = 1, night = 2 };

struct ColorConfiguration {
  ColorPreset preset = ColorPreset::green;  // preset of the following colours; each can then be set alone
  Rgb video{0.30, 0.95, 0.42};              // colour of the brightest video; darker video has fractions of this colour
  Rgb symbols{0.72, 1.0, 0.76};             // colour of symbols, brighter than the brightest video
  Rgb lines{0.22, 0.55, 0.28};              // colour of range arcs and lines, which are drawn below the symbols
};

// The colours of a preset: green phosphor, neutral grays, or dim red for the night.
inline ColorConfiguration color_preset(ColorPreset preset) {
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

// Radar display: visible area, size, range arcs and colours. Filled by the GUF forms RbmDisplay and Window.
struct ViewConfiguration {
  // Edges of the visible area as fractions of the selected range. The aircraft is at 0.
  double width_min = -0.6, width_max = 0.6;    // [1] left and right edge
  double height_min = -0.1, height_max = 1.1;  // [1] bottom and top edge
  int size_pixels = 480;                       // edge of the square display
  // [NM] spacing of the range arcs for each range. The last value also applies to ranges without a value. Empty: arcs
  // at 25, 50, 75 and 100 % of the range.
  std::vector<double> arc_spacing_nm{};
  ColorConfiguration colors{};
};

}  // namespace yars::radar
