#include "tools/scan_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lib/geo/bearing.hpp"

namespace yars::tools {

namespace {

using databuffer::Sweep;

// Phosphor at full brightness; a darker level scales it.
constexpr std::array<double, 3> kGreen{0.35, 1.0, 0.45};
constexpr std::array<double, 3> kGray{1.0, 1.0, 1.0};

// The sweep whose wedge holds an azimuth [deg true]; wedges are of one width but for rounding.
const Sweep* sweep_at(std::span<const Sweep> sweeps, double azimuth_deg) {
  const double from_left_deg = geo::wrapped_degrees(azimuth_deg - sweeps.front().azimuth_left_deg);
  const double width_deg = geo::wrapped_degrees(sweeps.front().azimuth_right_deg - sweeps.front().azimuth_left_deg);
  // A circular scan covers what lies left of its first edge too.
  const double turned_deg = from_left_deg < 0.0 ? from_left_deg + 360.0 : from_left_deg;
  const auto index = static_cast<std::size_t>(turned_deg / width_deg);
  return index < sweeps.size() ? &sweeps[index] : nullptr;
}

}  // namespace

imageio::Image scan_picture(std::span<const Sweep> sweeps, const radar::ViewConfiguration& view, ScanColor color) {
  const int size = view.size_pixels;
  imageio::Image image{size, size, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(size) * size * 3, 0)};
  const std::array<double, 3>& tint = color == ScanColor::green ? kGreen : kGray;
  const double track_deg = sweeps.front().ground_track_deg;
  for (int row = 0; row < size; ++row) {
    const double up = view.height_max - (row + 0.5) / size * (view.height_max - view.height_min);
    for (int column = 0; column < size; ++column) {
      const double right = view.width_min + (column + 0.5) / size * (view.width_max - view.width_min);
      const double range = std::hypot(right, up);
      if (range >= 1.0) continue;
      const Sweep* sweep = sweep_at(sweeps, track_deg + std::atan2(right, up) / geo::kRadiansPerDegree);
      if (sweep == nullptr) continue;
      const double level = sweep->video[static_cast<std::size_t>(range * sweep->samples)];
      std::uint8_t* pixel = &image.pixels[(static_cast<std::size_t>(row) * size + column) * 3];
      for (std::size_t channel = 0; channel < 3; ++channel) {
        pixel[channel] = static_cast<std::uint8_t>(std::lround(level * tint[channel]));
      }
    }
  }
  return image;
}

}  // namespace yars::tools
