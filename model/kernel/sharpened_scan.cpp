#include "model/kernel/sharpened_scan.hpp"

#include <algorithm>
#include <cmath>

#include "lib/radar/limits.hpp"
#include "lib/radar/map_formation.hpp"

namespace yars::model::kernel {

namespace {
// Of the scan that takes sector_time_s, and that the others stay within.
double full_width_deg(const radar::RadarConfiguration& configuration) {
  const std::vector<double>& widths = configuration.scan_widths_deg;
  return *std::max_element(widths.begin(), widths.end());
}
// A scan turns round in a tenth of the time that it sweeps: so much faster it has to sweep.
constexpr double kWithTurn = 1.1;

double sector_rate_dps(const radar::RadarConfiguration& configuration) {
  return kWithTurn * full_width_deg(configuration) / configuration.high_resolution.sector_time_s;
}
}  // namespace

radar::RadarConfiguration sharpened_configuration(const radar::RadarConfiguration& configuration) {
  radar::RadarConfiguration sharpened = configuration;
  sharpened.fidelity.samples = radar::kCellsOfMap;
  // Neighbours are seen apart: nothing of them is smeared into one another.
  sharpened.fidelity.azimuth_smear = false;
  sharpened.fidelity.sub_beams = 1;
  constexpr double kMetresAMicrosecond = 149.896229;  // c / 2
  for (std::size_t i = 0; i < sharpened.pulse_us.size() && i < sharpened.ranges_nm.size(); ++i) {
    const double cell_m = geo::Length::nautical_miles(sharpened.ranges_nm[i]).metres() / radar::kCellsOfMap;
    sharpened.pulse_us[i] = std::min(sharpened.pulse_us[i], cell_m / kMetresAMicrosecond);
  }
  return sharpened;
}

int ticks_a_sharpened_sweep(const radar::RadarConfiguration& configuration) {
  const double degrees_a_tick = sector_rate_dps(configuration) * radar::kTickSeconds;
  return std::max(1, static_cast<int>(std::lround(configuration.high_resolution.sector_step_deg / degrees_a_tick)));
}

antenna::Sector sharpened_sector(const databuffer::RadarCommand& command, const Pose& pose,
                                 const radar::RadarConfiguration& configuration) {
  antenna::Sector sector;
  sector.width_deg = command.scan_width_deg;
  sector.rate_dps = sector_rate_dps(configuration);
  const geo::GeoPoint cursor{command.cursor_latitude_deg, command.cursor_longitude_deg};
  const bool known = (command.flags & databuffer::kCursorValid) != 0U && std::isfinite(cursor.latitude_deg) &&
                     std::isfinite(cursor.longitude_deg);
  const double spare_deg = 0.5 * (full_width_deg(configuration) - sector.width_deg);
  if (!known || !(spare_deg > 0.0)) return sector;
  const geo::Bearing middle = antenna::scan_centre(pose.platform, configuration.antenna);
  const geo::Angle off = geo::geodesic_inverse(pose.place, cursor).azimuth_at_start - middle;
  sector.offset_deg = std::clamp(off.degrees(), -spare_deg, spare_deg);
  return sector;
}

SharpenedCell sharpened_cell(geo::Bearing left, geo::Bearing right, const Pose& pose,
                             const radar::RadarConfiguration& configuration) {
  const geo::Angle width = right - left;
  const geo::Bearing azimuth = left + 0.5 * width;
  const geo::Angle squint = azimuth - pose.platform.ground_track;
  const double cell_deg = radar::sharpened_beamwidth(squint, pose.ground_speed, configuration).degrees();
  if (cell_deg <= configuration.high_resolution.sector_step_deg) return {azimuth, width};
  const double middle_deg = (std::floor(squint.degrees() / cell_deg) + 0.5) * cell_deg;
  return {pose.platform.ground_track + geo::Angle::degrees(middle_deg), geo::Angle::degrees(cell_deg)};
}

geo::Angle elevation_to(const Pose& pose, geo::GeoPoint target, double ground_m) {
  const double distance_m = geo::geodesic_inverse(pose.place, target).distance.metres();
  const double height_m = pose.altitude.metres() - (std::isnan(ground_m) ? 0.0 : ground_m);
  return geo::Angle::radians(-std::atan2(height_m, std::max(distance_m, 1.0)));
}

}  // namespace yars::model::kernel
