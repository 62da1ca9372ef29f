#include "model/rbm/slant_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace yars::model::rbm {

namespace {
// Replaces voids by the last height before them, else by the first one, else by 0.
void fill_voids(std::span<double> height_m) {
  const auto is_known = [](double height) { return !std::isnan(height); };
  const auto first = std::ranges::find_if(height_m, is_known);
  double last_m = first == height_m.end() ? 0.0 : *first;
  for (double& height : height_m) height = last_m = is_known(height) ? height : last_m;
}
}  // namespace

SlantAxis::SlantAxis(std::size_t samples) : height_m_(samples), moved_(samples) {}

void SlantAxis::move(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth,
                     std::span<const float> height_m, std::span<float> power) {
  constexpr double kLeast = 1.0 / 64.0;  // [samples] least extent of an echo
  const double altitude_m = geometry.altitude.metres();
  const double spacing_m = geometry.range.metres() / static_cast<double>(power.size());
  std::copy(height_m.begin(), height_m.end(), height_m_.begin());
  fill_voids(height_m_);
  std::fill(moved_.begin(), moved_.end(), 0.0);
  // Slant range in samples.
  const auto slant = [&](double distance_m, double height) {
    return earth.slant_range_m(altitude_m, distance_m, height) / spacing_m;
  };
  double near = slant(0.0, height_m_[0]);
  for (std::size_t i = 0; i < power.size(); ++i) {
    const double from_m = static_cast<double>(i) * spacing_m, to_m = from_m + spacing_m;
    const double far = slant(to_m, i + 1 < power.size() ? 0.5 * (height_m_[i] + height_m_[i + 1]) : height_m_[i]);
    // The pulse covers more ground the more its extent in slant range is below that over ground. Level ground returns
    // as much in a cell of slant range.
    const double echo = static_cast<double>(power[i]) * (slant(to_m, height_m_[i]) - slant(from_m, height_m_[i]));
    const double begin = std::min(near, far), end = std::max({near, far, begin + kLeast});
    const auto last = std::min(static_cast<std::size_t>(end), power.size() - 1);
    for (auto k = static_cast<std::size_t>(begin); k <= last; ++k) {
      const double covered = std::min(end, static_cast<double>(k + 1)) - std::max(begin, static_cast<double>(k));
      moved_[k] += echo * std::max(covered, 0.0) / (end - begin);
    }
    near = far;
  }
  std::transform(moved_.begin(), moved_.end(), power.begin(), [](double value) { return static_cast<float>(value); });
}

std::vector<ShownGround> shown_at_slant_ranges(const physics::SweepGeometry& geometry,
                                               const physics::EffectiveEarth& earth, std::span<const double> distance_m,
                                               std::span<const double> height_m, std::span<const std::uint8_t> lit) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double spacing_m = geometry.range.metres() / static_cast<double>(distance_m.size());
  std::vector<double> heights(height_m.begin(), height_m.end());
  fill_voids(heights);
  const auto slant = [&](std::size_t i) {
    return earth.slant_range_m(geometry.altitude.metres(), distance_m[i], heights[i]) / spacing_m - 0.5;
  };
  std::vector<ShownGround> shown(distance_m.size(), {kNone, false, false});
  for (std::size_t i = 0; i + 1 < distance_m.size(); ++i) {
    const double near = slant(i), far = slant(i + 1);
    const bool seen = lit[i] != 0 || lit[i + 1] != 0;
    const double last = std::min(std::max(near, far), static_cast<double>(shown.size() - 1));
    for (double k = std::ceil(std::max(std::min(near, far), 0.0)); k <= last; k += 1.0) {
      ShownGround& here = shown[static_cast<std::size_t>(k)];
      here.laid_over = here.laid_over || (here.lit && seen);
      if (!std::isnan(here.distance_m) && (here.lit || !seen)) continue;
      const double part = far == near ? 0.0 : (k - near) / (far - near);
      here = {distance_m[i] + part * (distance_m[i + 1] - distance_m[i]), seen, false};
    }
  }
  return shown;
}

}  // namespace yars::model::rbm
