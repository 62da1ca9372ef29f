#include "lib/radar/mappable.hpp"

#include <cmath>

#include "lib/radar/map_formation.hpp"
#include "lib/radar/windows.hpp"

namespace yars::radar {

namespace {

bool is_finite(geo::GeoPoint point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg);
}


// True if a blank selection stands for this window at this range, or, without a size, for any.
bool blank_allows(geo::Length range, geo::Length size, const WindowLimits& table) {
  const std::optional<geo::Length> taken = window_while_blank(range, table);
  return taken && (size == geo::Length() || std::abs((*taken - size).nautical_miles()) < kSameWindow_nm);
}

}  // namespace

std::optional<std::string_view> why_not_mappable(const MapViewpoint& from, geo::GeoPoint place, const MapWindow& window,
                                                 const RadarConfiguration& configuration) {
  if (!is_finite(from.aircraft) || !is_finite(place)) return "NO CURSOR";
  const geo::GeodesicInverse way = geo::geodesic_inverse(from.aircraft, place);
  if (in_blind_zone(way.azimuth_at_start - from.ground_track, configuration.high_resolution)) return "BLIND ZONE";
  const geo::Angle off_nose = way.azimuth_at_start - from.heading;
  if (std::abs(off_nose.degrees()) > configuration.antenna.azimuth_limit_deg) return "GIMBAL";
  const bool blank = window.blank || window.size == geo::Length();
  if (blank && blank_allows(way.distance, window.size, configuration.window_limits)) return std::nullopt;
  const auto limits = cursor_limits(window.size, configuration.window_limits);
  if (!limits) return "NO WINDOW";
  if (way.distance < limits->least) return "MIN RANGE";
  if (way.distance > limits->greatest) return "MAX RANGE";
  return std::nullopt;
}

}  // namespace yars::radar
