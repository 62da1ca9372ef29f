#include "databuffer/records/navigation.hpp"

#include <cmath>

#include "lib/radar/ground_track.hpp"

namespace yars::databuffer {

namespace {

using geo::GeoPoint;

bool same(GeoPoint a, GeoPoint b) {
  return a.latitude_deg == b.latitude_deg && a.longitude_deg == b.longitude_deg;
}

bool is_set(GeoPoint point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg) &&
         (point.latitude_deg != 0.0 || point.longitude_deg != 0.0);
}

// A place as seen from one point, laid off from another.
GeoPoint carried(GeoPoint from, GeoPoint to, GeoPoint place) {
  if (same(from, to)) return place;
  const geo::GeodesicInverse line = geo::geodesic_inverse(from, place);
  return geo::geodesic_direct(to, line.azimuth_at_start, line.distance);
}

GeoPoint moved(GeoPoint place, double north_m, double east_m) {
  if (north_m == 0.0 && east_m == 0.0) return place;
  const auto azimuth = geo::Bearing::radians(std::atan2(east_m, north_m));
  return geo::geodesic_direct(place, azimuth, geo::Length::metres(std::hypot(north_m, east_m)));
}

}  // namespace

geo::Bearing ground_track_of(const Ownship& ownship) {
  return radar::ground_track(geo::Speed::metres_per_second(ownship.velocity_north_mps),
                             geo::Speed::metres_per_second(ownship.velocity_east_mps),
                             geo::Bearing::degrees(ownship.heading_deg));
}

GeoPoint Belief::on_video(GeoPoint known) const {
  return carried(believed, truth, known);
}

GeoPoint Belief::known_from_video(GeoPoint place) const {
  return carried(truth, believed, place);
}

Belief belief_of(radar::Navigator navigator, const Ownship& ownship, const Nav& nav, const RadarState& state) {
  const bool ins = navigator == radar::Navigator::ins;
  const GeoPoint truth{ownship.latitude_deg, ownship.longitude_deg};
  const GeoPoint given = ins ? GeoPoint{nav.ins_latitude_deg, nav.ins_longitude_deg}
                             : GeoPoint{nav.mission_latitude_deg, nav.mission_longitude_deg};
  const NavigatorError& error = ins ? state.ins : state.mission;
  return {truth, moved(is_set(given) ? given : truth, error.north_m, error.east_m)};
}

Belief belief_in_use(const Ownship& ownship, const Nav& nav, const RadarState& state) {
  return belief_of(static_cast<radar::Navigator>(state.navigator), ownship, nav, state);
}

}  // namespace yars::databuffer
