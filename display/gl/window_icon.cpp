#include "display/gl/window_icon.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace yars::display::gl {

namespace {

// Light 0..1 at a position relative to the apex, in icon edges: the sector brightens to the right, where the antenna
// has just been; arcs at each third of the range.
double light_at(double right, double ahead) {
  constexpr double kRange = 0.84, kHalfSector_rad = std::numbers::pi / 4.0, kLine = 0.035;
  const double range = std::hypot(right, ahead);
  const double azimuth = std::atan2(right, ahead);
  if (range > kRange || std::abs(azimuth) > kHalfSector_rad) return 0.0;
  const double phase = std::fmod(range + kLine / 2.0, kRange / 3.0);
  if (phase < kLine && range > kLine) return 1.0;
  return 0.25 + 0.45 * (azimuth + kHalfSector_rad) / (2.0 * kHalfSector_rad);
}

}  // namespace

imageio::Image window_icon(int size) {
  imageio::Image icon{size, size, 4, {}};
  icon.pixels.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double right = (x + 0.5) / size - 0.5, ahead = 0.94 - (y + 0.5) / size;
      const double light = light_at(right, ahead);
      const auto channel = [light](double full) { return static_cast<std::uint8_t>(10.0 + 240.0 * full * light); };
      icon.pixels.insert(icon.pixels.end(), {channel(0.4), channel(1.0), channel(0.5), std::uint8_t{255}});
    }
  }
  return icon;
}

}  // namespace yars::display::gl
