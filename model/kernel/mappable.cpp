#include "model/kernel/mappable.hpp"

#include <cmath>

#include "lib/radar/map_formation.hpp"
#include "lib/radar/windows.hpp"

namespace yars::model::kernel {

namespace {
bool is_finite(geo::GeoPoint point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg);
}
}  // namespace

std::optional<std::string_view> why_not_mappable(const antenna::Platform& platform, geo::GeoPoint aircraft,
                                                 geo::GeoPoint cursor, geo::Length window,
                                                 const radar::RadarConfiguration& configuration) {
  if (!is_finite(aircraft) || !is_finite(cursor)) return "NO CURSOR";
  const geo::GeodesicInverse way = geo::geodesic_inverse(aircraft, cursor);
  const geo::Angle off_track = way.azimuth_at_start - platform.ground_track;
  if (radar::in_blind_zone(off_track, configuration.high_resolution)) return "BLIND ZONE";
  const geo::Angle off_nose = way.azimuth_at_start - platform.heading;
  if (std::abs(off_nose.degrees()) > configuration.antenna.azimuth_limit_deg) return "GIMBAL";
  const std::optional<geo::Length> taken = window > geo::Length()
                                               ? std::optional(window)
                                               : radar::window_while_blank(way.distance, configuration.window_limits);
  if (!taken) return "NO WINDOW";
  const auto limits = radar::cursor_limits(*taken, configuration.window_limits);
  if (!limits) return "NO WINDOW";
  if (window == geo::Length()) return std::nullopt;  // the blank window's own limits are those of rule 4
  if (way.distance < limits->least) return "MIN RANGE";
  if (way.distance > limits->greatest) return "MAX RANGE";
  return std::nullopt;
}

}  // namespace yars::model::kernel
