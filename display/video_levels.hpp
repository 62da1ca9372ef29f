// From the receiver's 8-bit video to light on the glass: eight grays, with the pilot's brightness and contrast.
// Contrast turns the curve about the middle, 8 leaves it as it is; four steps double or halve the slope.
// Brightness is the light of the highest gray: (b / 15)^0.35, so that 0 is dark and 8 is four fifths.
#pragma once

#include <array>
#include <cstdint>

namespace yars::display {

inline constexpr int kGrays = 8;

// [video] -> light 0..1; `brightness` and `contrast` 0..15.
std::array<float, 256> video_light(int brightness, int contrast);

}  // namespace yars::display
