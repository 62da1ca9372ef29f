#include "lib/radar/mission.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lib/error/error.hpp"
#include "lib/radar/sensor.hpp"

namespace yars::radar {

geo::Length range_by_height(geo::Length height, const HeightRanges& table) {
  YARS_REQUIRE(table.ranges_nm.size(), ==, table.heights_ft.size() + 1);
  const auto found = std::find_if(table.heights_ft.begin(), table.heights_ft.end(),
                                  [height](double height_ft) { return height <= geo::Length::feet(height_ft); });
  return geo::Length::nautical_miles(table.ranges_nm[static_cast<std::size_t>(found - table.heights_ft.begin())]);
}

std::size_t range_index_for(geo::Length wanted, std::span<const double> ranges_nm) {
  YARS_REQUIRE(ranges_nm.size(), >, std::size_t{0});
  const auto found = std::find_if(ranges_nm.begin(), ranges_nm.end(), [wanted](double range_nm) {
    return geo::Length::nautical_miles(range_nm) >= wanted;
  });
  if (found == ranges_nm.end()) return ranges_nm.size() - 1;
  return static_cast<std::size_t>(found - ranges_nm.begin());
}

namespace {
// [NM] Window sizes that differ by less count as equal. Different sizes differ by 0.01 NM or more. The tolerance covers
// rounding by unit conversion.
constexpr double kSameWindow_nm = 0.005;
}  // namespace

std::optional<CursorLimits> cursor_limits(geo::Length window, const WindowLimits& table) {
  const auto found = std::find_if(table.windows_nm.begin(), table.windows_nm.end(), [window](double candidate_nm) {
    return std::abs(candidate_nm - window.nautical_miles()) < kSameWindow_nm;
  });
  const auto row = static_cast<std::size_t>(found - table.windows_nm.begin());
  if (row >= table.windows_nm.size() || row >= table.min_range_nm.size() || row >= table.max_range_nm.size()) return {};
  return CursorLimits{geo::Length::nautical_miles(table.min_range_nm[row]),
                      geo::Length::nautical_miles(table.max_range_nm[row])};
}

std::optional<std::size_t> largest_window_that_fits(geo::Length range, std::span<const double> windows_nm) {
  const auto beyond = std::find_if(windows_nm.begin(), windows_nm.end(), [range](double window_nm) {
    return geo::Length::nautical_miles(window_nm) > range;
  });
  if (beyond == windows_nm.begin()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(windows_nm.begin(), beyond)) - 1;
}

std::optional<geo::Length> window_of_blank_selection(geo::Length cursor_range, const WindowLimits& table) {
  if (!(cursor_range >= geo::Length::nautical_miles(table.blank_min_range_nm))) return std::nullopt;
  const std::size_t rows = std::min(table.blank_windows_nm.size(), table.blank_max_range_nm.size());
  for (std::size_t row = 0; row < rows; ++row) {
    if (cursor_range <= geo::Length::nautical_miles(table.blank_max_range_nm[row]))
      return geo::Length::nautical_miles(table.blank_windows_nm[row]);
  }
  return std::nullopt;
}

namespace {
constexpr double kSpeedOfLight_mps = 299792458.0;  // exact

double wavelength_m(const SyntheticArray& array) {
  return kSpeedOfLight_mps / (array.frequency_ghz * 1e9);
}
}  // namespace

geo::Length map_resolution(geo::Length window) {
  return window / kMapCells;
}

int map_strips(geo::Length window, geo::Length slant_range, geo::Angle azimuth_beamwidth) {
  const double swath_m = slant_range.metres() * azimuth_beamwidth.radians();
  constexpr double kMaxStrips = 1000.0;  // keeps the result within int
  return static_cast<int>(std::clamp(std::ceil(window.metres() / swath_m), 1.0, kMaxStrips));
}

geo::Duration formation_time(const MapGeometry& geometry, const SyntheticArray& array) {
  const double doppler_mps = geometry.ground_speed.metres_per_second() * std::abs(std::sin(geometry.squint.radians()));
  const double strip_s = array.broadening * wavelength_m(array) * geometry.slant_range.metres() /
                         (2.0 * doppler_mps * map_resolution(geometry.window).metres());
  const int strips =
      map_strips(geometry.window, geometry.slant_range, geo::Angle::degrees(array.azimuth_beamwidth_deg));
  const double whole_s = strip_s * geometry.looks * strips;
  // At zero speed or zero squint `whole_s` is infinite or NaN. The comparison then selects the cap.
  return geo::Duration::seconds(whole_s < array.max_formation_time_s ? whole_s : array.max_formation_time_s);
}

bool in_blind_zone(geo::Angle squint, double blind_zone_deg) {
  // The Doppler spread is small ahead and astern.
  const double off_deg = std::abs(geo::wrapped_degrees(squint.degrees()));
  return std::min(off_deg, 180.0 - off_deg) < blind_zone_deg;
}

geo::Angle dbs_beamwidth(geo::Angle squint, geo::Speed ground_speed, const SyntheticArray& array) {
  const geo::Angle beam = geo::Angle::degrees(array.azimuth_beamwidth_deg);
  const double doppler_mps = ground_speed.metres_per_second() * std::abs(std::sin(squint.radians()));
  const double sharpened_rad = wavelength_m(array) / (2.0 * doppler_mps * array.dwell_s);
  return sharpened_rad < beam.radians() ? geo::Angle::radians(sharpened_rad) : beam;
}

namespace {

bool is_finite(geo::GeoPoint point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg);
}

// True if a blank selection gives the window `size` at the cursor range `range`. A zero `size` matches every window.
bool blank_allows(geo::Length range, geo::Length size, const WindowLimits& table) {
  const std::optional<geo::Length> window = window_of_blank_selection(range, table);
  return window && (size == geo::Length() || std::abs((*window - size).nautical_miles()) < kSameWindow_nm);
}

// Message of the display if a map with this window is not possible at the cursor range `range`; nullopt if possible.
std::optional<std::string_view> range_rejection(geo::Length range, const MapWindow& window, const WindowLimits& table) {
  const bool blank = window.blank || window.size == geo::Length();
  if (blank && blank_allows(range, window.size, table)) return std::nullopt;
  const auto ranges = cursor_limits(window.size, table);
  if (!ranges) return "NO WINDOW";
  if (range < ranges->min) return "MIN RANGE";
  if (range > ranges->max) return "MAX RANGE";
  return std::nullopt;
}

// The servo limits the elevation against the horizon. The gimbal limits azimuth and elevation in airframe axes.
bool antenna_reaches(const Platform& platform, geo::Bearing azimuth, geo::Angle elevation,
                     const AntennaConfiguration& antenna) {
  return std::abs(elevation.degrees()) <= antenna.elevation_limit_deg + antenna.tolerance_deg &&
         within_gimbal(platform, antenna, azimuth, elevation);
}

}  // namespace

geo::Angle elevation_to_ground(geo::AltitudeMsl altitude, geo::Length distance, double ground_m) {
  const double height_m = altitude.metres() - (std::isnan(ground_m) ? 0.0 : ground_m);
  return geo::Angle::radians(-std::atan2(height_m, std::max(distance.metres(), 1.0)));
}

std::optional<std::string_view> map_rejection(const MapViewpoint& from, const MapCentre& centre,
                                              const MapWindow& window, const MapLimits& limits) {
  if (!is_finite(from.aircraft) || !is_finite(centre.position)) return "NO CURSOR";
  const geo::GeodesicInverse path = geo::geodesic_inverse(from.aircraft, centre.position);
  if (in_blind_zone(path.azimuth_at_start - from.platform.ground_track, limits.blind_zone_deg)) return "BLIND ZONE";
  const geo::Angle off_nose = path.azimuth_at_start - from.platform.heading;
  if (std::abs(off_nose.degrees()) > limits.antenna.azimuth_limit_deg) return "GIMBAL";
  if (const auto reason = range_rejection(path.distance, window, limits.windows)) return reason;
  if (!centre.ground_m) return std::nullopt;
  const geo::Angle elevation = elevation_to_ground(from.altitude, path.distance, *centre.ground_m);
  if (!antenna_reaches(from.platform, path.azimuth_at_start, elevation, limits.antenna)) return "GIMBAL";
  return std::nullopt;
}

}  // namespace yars::radar
