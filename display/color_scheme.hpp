// Colors of the glass, each channel 0..1. The default is that of the built-in configuration, a green phosphor.
#pragma once

#include "display/draw_list.hpp"
#include "lib/radar/colors.hpp"

namespace yars::display {

struct Color {
  float red = 0.0F, green = 0.0F, blue = 0.0F;
};

struct ColorScheme {
  Color ground{0.0F, 0.0F, 0.0F};
  Color video{0.30F, 0.95F, 0.42F};  // full light; grays are fractions of it
  Color bright{0.72F, 1.0F, 0.76F};  // symbols stand out from the brightest video
  Color dim{0.22F, 0.55F, 0.28F};    // arcs and lines below them

  Color of(Ink ink) const { return ink == Ink::dim ? dim : bright; }
};

ColorScheme color_scheme(const radar::ColorConfiguration& colors);

}  // namespace yars::display
