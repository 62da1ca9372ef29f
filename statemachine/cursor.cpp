#include "statemachine/cursor.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/geodesic.hpp"
#include "lib/radar/ground_track.hpp"
#include "statemachine/sequence_points.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using geo::Bearing;
using geo::GeoPoint;
using geo::Length;
using radar::ViewConfiguration;

constexpr double kCrossingSeconds = 2.0;  // [s] full deflection across the glass: pvi.md, hands-on controls

// A place on the glass in fractions of the range: right and up from the apex.
struct GlassPoint {
  double x = 0.0;
  double y = 0.0;
};

GeoPoint aircraft_of(const Surroundings& surroundings) {
  return {surroundings.ownship.latitude_deg, surroundings.ownship.longitude_deg};
}

GeoPoint cursor_of(const RadarState& state) {
  return {state.cursor_latitude_deg, state.cursor_longitude_deg};
}

void put_cursor(RadarState& state, GeoPoint place) {
  state.cursor_latitude_deg = place.latitude_deg;
  state.cursor_longitude_deg = place.longitude_deg;
  set_flag(state, databuffer::kCursorValid, true);
}

// Between the two transforms lies what the glass shows: geodesic distance and azimuth, plotted flat.
GlassPoint glass_from_ground(const RadarState& state, GeoPoint place) {
  const auto inverse = geo::geodesic_inverse({state.frame_latitude_deg, state.frame_longitude_deg}, place);
  const double turn_rad = (inverse.azimuth_at_start - Bearing::degrees(state.frame_track_deg)).radians();
  const double radius = inverse.distance.nautical_miles() / state.range_nm;
  return {radius * std::sin(turn_rad), radius * std::cos(turn_rad)};
}

GeoPoint ground_from_glass(const RadarState& state, GlassPoint point) {
  const Bearing azimuth = Bearing::degrees(state.frame_track_deg) + geo::Angle::radians(std::atan2(point.x, point.y));
  const Length distance = Length::nautical_miles(std::hypot(point.x, point.y) * state.range_nm);
  return geo::geodesic_direct({state.frame_latitude_deg, state.frame_longitude_deg}, azimuth, distance);
}

bool on_glass(GlassPoint point, const ViewConfiguration& view) {
  return point.x >= view.width_min && point.x <= view.width_max && point.y >= view.height_min &&
         point.y <= view.height_max;
}

void follow_aircraft(RadarState& state, const Surroundings& surroundings) {
  // The frozen picture stays where its last sweep was; until the scan has ended it is not frozen.
  const bool frozen = has(state, databuffer::kFreeze) && (surroundings.model.flags & databuffer::kModelFrozen) != 0;
  if (frozen) return;
  const databuffer::Ownship& ownship = surroundings.ownship;
  state.frame_latitude_deg = ownship.latitude_deg;
  state.frame_longitude_deg = ownship.longitude_deg;
  state.frame_track_deg = radar::ground_track(geo::Speed::metres_per_second(ownship.velocity_north_mps),
                                              geo::Speed::metres_per_second(ownship.velocity_east_mps),
                                              Bearing::degrees(ownship.heading_deg))
                              .degrees();
}

void place_cursor(RadarState& state, const radar::RadarConfiguration& configuration) {
  const radar::RoutePoint* point = selected_point(state, configuration);
  const bool seen = point && on_glass(glass_from_ground(state, point->place), configuration.view);
  put_cursor(state, seen ? point->place : ground_from_glass(state, {0.0, 0.5}));
}

// PVU shows no cursor; in A/A and ranging there is no picture to slew it over.
bool can_slew(const RadarState& state) {
  const radar::Mode mode = running_mode(state);
  return mode != radar::Mode::pvu && mode != radar::Mode::air_to_air && mode != radar::Mode::ranging;
}

void slew(RadarState& state, const ViewConfiguration& view) {
  if (!can_slew(state) || (state.tdc_x == 0.0 && state.tdc_y == 0.0)) return;
  const double share = radar::kTickSeconds / kCrossingSeconds;
  const GlassPoint from = glass_from_ground(state, cursor_of(state));
  const double x = from.x + state.tdc_x * share * (view.width_max - view.width_min);
  const double y = from.y + state.tdc_y * share * (view.height_max - view.height_min);
  put_cursor(state, ground_from_glass(state, {std::clamp(x, view.width_min, view.width_max),
                                              std::clamp(y, view.height_min, view.height_max)}));
}

void read_out(RadarState& state, const Surroundings& surroundings, const radar::RadarConfiguration& configuration) {
  const auto inverse = geo::geodesic_inverse(aircraft_of(surroundings), cursor_of(state));
  const double given_deg = surroundings.nav.magnetic_variation_deg;
  const double variation_deg = std::isnan(given_deg) ? configuration.magnetic_variation_deg : given_deg;
  state.cursor_bearing_deg = (inverse.azimuth_at_start - geo::Angle::degrees(variation_deg)).degrees();
  state.cursor_range_nm = inverse.distance.nautical_miles();
  state.cursor_elevation_m = surroundings.model.cursor_ground_elevation_m;
}

}  // namespace

void deflect(Step& step) {
  if (!std::isfinite(step.event.x) || !std::isfinite(step.event.y)) return;
  step.state.tdc_x = std::clamp(step.event.x, -1.0, 1.0);
  step.state.tdc_y = std::clamp(step.event.y, -1.0, 1.0);
}

void next_cursor_function(Step& step) {
  constexpr int kFunctions = 5;
  step.state.cursor_function = static_cast<std::uint8_t>((step.state.cursor_function + 1) % kFunctions);
}

void jump_cursor(RadarState& state, const radar::RoutePoint& point) {
  put_cursor(state, point.place);
}

void advance_cursor(RadarState& state, const Surroundings& surroundings,
                    const radar::RadarConfiguration& configuration) {
  follow_aircraft(state, surroundings);
  if (!has(state, databuffer::kCursorValid)) place_cursor(state, configuration);
  slew(state, configuration.view);
  read_out(state, surroundings, configuration);
}

}  // namespace yars::statemachine
