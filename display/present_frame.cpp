#include "display/present_frame.hpp"

#include <cmath>

#include "lib/radar/ground_track.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

namespace {

constexpr double kLeastRange_m = 1852.0;  // [m] stands in for a state that names no range yet: nothing divides by 0

geo::GeoPoint believed_position(const GlassInput& input) {
  if (input.state.navigator == static_cast<std::uint8_t>(radar::Navigator::ins)) {
    return {input.nav.ins_latitude_deg, input.nav.ins_longitude_deg};
  }
  return {input.nav.mission_latitude_deg, input.nav.mission_longitude_deg};
}

// A lane that no navigator has written holds zeros.
bool is_set(geo::GeoPoint point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg) &&
         (point.latitude_deg != 0.0 || point.longitude_deg != 0.0);
}

}  // namespace

geo::Bearing ground_track_of(const databuffer::Ownship& ownship) {
  return radar::ground_track(geo::Speed::metres_per_second(ownship.velocity_north_mps),
                             geo::Speed::metres_per_second(ownship.velocity_east_mps),
                             geo::Bearing::degrees(ownship.heading_deg));
}

GlassFrame present_frame(const GlassInput& input, const StoredSweep* newest) {
  const double range_m = input.state.range_nm * geo::kMetresPerNauticalMile;
  GlassFrame frame;
  frame.range_m = range_m > 0.0 ? range_m : kLeastRange_m;
  const bool frozen = (input.model.flags & databuffer::kModelFrozen) != 0;
  if (frozen && newest != nullptr) {
    frame.apex = newest->apex;
    frame.up = newest->ground_track;
  } else {
    frame.apex = {input.ownship.latitude_deg, input.ownship.longitude_deg};
    frame.up = ground_track_of(input.ownship);
  }
  return frame;
}

geo::GeoPoint seen_through_navigator(const GlassInput& input, geo::GeoPoint place) {
  const geo::GeoPoint believed = believed_position(input);
  if (!is_set(believed)) return place;
  // Bearing and range from where the navigator believes to be, laid off from where the aircraft is.
  const geo::GeoPoint truth{input.ownship.latitude_deg, input.ownship.longitude_deg};
  const geo::GeodesicInverse line = geo::geodesic_inverse(believed, place);
  return geo::geodesic_direct(truth, line.azimuth_at_start, line.distance);
}

}  // namespace yars::display
