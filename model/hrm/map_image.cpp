#include "model/hrm/map_image.hpp"

#include <algorithm>
#include <cmath>

#include "lib/radar/map_formation.hpp"
#include "model/hrm/fan_lanes.hpp"

namespace yars::model::hrm {

namespace {
// Grazing nearly level would make the unit vanish; the picture is dark there anyway.
constexpr double kLeastSine = 1.0e-3;
}  // namespace

double unit_return_m2(const PatchGeometry& geometry, int pixels) {
  const double pixel_m = geometry.window_m() / pixels;
  return pixel_m * pixel_m * std::max(geometry.sin_grazing(), kLeastSine);
}

void draw_fan(const PatchGeometry& geometry, const FanGrid& grid, const float* cross_section_m2, int first, int last,
              MapImage& image) {
  const double pixel_m = geometry.window_m() / image.size;
  const double edge_m = 0.5 * geometry.window_m();
  lanes::MapRow row;
  row.columns = image.size;
  row.first_right_m = static_cast<float>(0.5 * pixel_m - edge_m);
  row.pixel_m = static_cast<float>(pixel_m);
  row.scale = static_cast<float>(pixel_m * pixel_m / unit_return_m2(geometry, image.size));
  for (int line = first; line < last; ++line) {
    row.ahead_m = static_cast<float>(geometry.distance_m() + edge_m - (line + 0.5) * pixel_m);
    lanes::draw_row(grid, cross_section_m2, row, &image.power[image.at(0, line)]);
  }
}

void blank_blind_zone(const PatchGeometry& geometry, geo::Bearing ground_track,
                      const radar::HighResolutionConfiguration& configuration, MapImage& image) {
  const double pixel_m = geometry.window_m() / image.size;
  const double edge_m = 0.5 * geometry.window_m();
  const geo::Angle squint = geometry.squint(ground_track);
  // The whole picture clear of it by its half diagonal: nothing to look at.
  const double half_view_deg =
      std::atan2(edge_m, std::max(geometry.distance_m() - edge_m, 1.0)) / geo::kRadiansPerDegree;
  const double off_deg = std::abs(squint.degrees());
  const double clear_deg = std::min(off_deg, 180.0 - off_deg) - configuration.blind_zone_deg;
  if (clear_deg > half_view_deg) return;
  for (int row = 0; row < image.size; ++row) {
    const double ahead_m = geometry.distance_m() + edge_m - (row + 0.5) * pixel_m;
    for (int column = 0; column < image.size; ++column) {
      const double right_m = (column + 0.5) * pixel_m - edge_m;
      const geo::Angle turn = geo::Angle::radians(std::atan2(right_m, ahead_m));
      if (!radar::in_blind_zone(squint + turn, configuration)) continue;
      image.power[image.at(column, row)] = -1.0F;
      image.blind = true;
    }
  }
}

}  // namespace yars::model::hrm
