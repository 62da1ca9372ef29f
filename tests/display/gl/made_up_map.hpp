// Picture of a made-up area as in a patch map, for tests of the display: fields, a runway, a river, a town with
// shadows, speckle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace yars::display::testing {

// Pseudo-random number in [0, 1), a function of the pixel.
inline double speckle(int x, int y) {
  std::uint32_t mixed = static_cast<std::uint32_t>(x) * 0x9e3779b1U ^ static_cast<std::uint32_t>(y) * 0x85ebca77U;
  mixed = (mixed ^ (mixed >> 15)) * 0x2c1b3c6dU;
  return static_cast<double>((mixed ^ (mixed >> 13)) & 0xffffU) / 65536.0;
}

// Brightness of the ground, 0 to 1, at a position in the unit square; y counts from the far edge.
inline double ground_at(double x, double y) {
  const double across = (x - 0.5) * 0.9 + (y - 0.5) * 0.44;
  if (std::abs(across) < 0.018 && y > 0.2 && y < 0.85) return 0.06;  // runway
  const double river = x - 0.16 - 0.06 * std::sin(9.0 * y);
  if (std::abs(river) < 0.025) return 0.02;
  const bool town = x > 0.62 && x < 0.9 && y > 0.15 && y < 0.4;
  if (town) {
    const double u = std::fmod(x * 22.0, 1.0), v = std::fmod(y * 22.0, 1.0);  // position within a block
    if (u > 0.25 && u < 0.8 && v > 0.6 && v < 0.8) return 1.0;                // near wall
    if (u > 0.25 && u < 0.8 && v > 0.15 && v <= 0.6) return 0.0;              // shadow
    return 0.3;
  }
  return 0.34 + 0.14 * std::sin(7.0 * x) * std::cos(5.0 * y);
}

inline std::vector<std::uint8_t> made_up_ground(int size) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double ground = ground_at((x + 0.5) / size, (y + 0.5) / size);
      const double level = 255.0 * std::min(1.0, ground * (0.6 + 0.8 * speckle(x, y)));
      pixels.push_back(static_cast<std::uint8_t>(level));
    }
  }
  return pixels;
}

}  // namespace yars::display::testing
