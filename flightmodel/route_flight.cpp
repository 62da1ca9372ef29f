#include "flightmodel/route_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/file/text_file.hpp"
#include "lib/values/fields.hpp"

namespace yars::flightmodel {

namespace {

using error::Expected;
using error::fail;

constexpr double kMinLeg_m = 100.0;  // [m] minimum length of a leg; the direction of a shorter leg is ill-defined

Expected<Waypoint> parse_waypoint(const text::NumberedLine& line, std::string_view name) {
  const auto numbers =
      file::parse_numbers(file::line_location(name, line.number), text::words_of(line.text),
                          {{"LAT", -90.0, 90.0},
                           {"LON", -180.0, 180.0},
                           {"ALT_FT", values::Reposition::altitude.low, values::Reposition::altitude.high},
                           {"KT", values::Reposition::speed.low, values::Reposition::speed.high}},
                          " ");
  if (!numbers) return tl::unexpected(numbers.error());
  const auto& value = *numbers;
  return Waypoint{{value[0], value[1]}, geo::AltitudeMsl::feet(value[2]), geo::Speed::knots(value[3])};
}

bool too_close(const Waypoint& from, const Waypoint& to) {
  return geo::geodesic_inverse(from.point, to.point).distance.metres() < kMinLeg_m;
}

// Marks the route as a loop. Error: the leg from the last to the first waypoint is shorter than kMinLeg_m.
Expected<void> close_loop(Route& route, const std::string& line_name) {
  route.loop = true;
  if (route.waypoints.size() < 2 || !too_close(route.waypoints.back(), route.waypoints.front())) return {};
  return fail(line_name, "a last waypoint at least 100 m from the first", "a closer one",
              "leave out the last waypoint: `loop` adds the leg to the first");
}

}  // namespace

std::size_t Route::after(std::size_t waypoint) const {
  const std::size_t next = waypoint + 1;
  return next == waypoints.size() && loop ? 0 : next;
}

Expected<Route> parse_route(std::string_view text, std::string_view name) {
  Route route;
  for (const text::NumberedLine& line : text::numbered_lines(text)) {
    const std::string line_name = file::line_location(name, line.number);
    if (route.loop) return fail(line_name, "nothing behind loop", '"' + std::string(line.text) + '"');
    if (line.text == "loop") {
      if (auto closed = close_loop(route, line_name); !closed) return tl::unexpected(closed.error());
      continue;
    }
    const auto waypoint = parse_waypoint(line, name);
    if (!waypoint) return tl::unexpected(waypoint.error());
    if (!route.waypoints.empty() && too_close(route.waypoints.back(), *waypoint))
      return fail(line_name, "a waypoint at least 100 m from the previous one", "a closer one");
    route.waypoints.push_back(*waypoint);
  }
  if (route.waypoints.size() < 2)
    return fail(std::string(name), "at least two waypoints, one line LAT LON ALT_FT KT each",
                std::to_string(route.waypoints.size()));
  return route;
}

namespace {

constexpr double kGravity_mps2 = 9.80665;  // [m/s^2] standard gravity; turn radius is inversely proportional to it
constexpr double kMaxStep_s = 0.02;        // [s] maximum integration step; longer steps distort roll-in and roll-out
// [1/s] Climb rate per altitude error. Its product with kClimbLimit is kAcceleration_mps2. A larger value would need a
// higher acceleration when levelling off.
constexpr double kClimbGain_per_s = 0.1;
constexpr double kMaxLeadTurn_deg = 120.0;  // [deg] maximum turn in lead(); the tangent length diverges at 180 deg
// Bank for planning turns. The margin to kBankLimit allows corrections for roll-in and for changes of speed.
constexpr geo::Angle kPlannedBank = geo::Angle::degrees(27.0);
constexpr double kCaptureTime_s = 8.0;      // [s] time constant of the decay of a small distance from the leg
constexpr double kTrackGain_per_s = 0.3;    // [1/s] turn rate per track error; its inverse exceeds the 2 s of a roll-in
constexpr double kMaxIntercept_deg = 90.0;  // [deg] maximum of intercept()
// [deg] Track error beyond which a turn in progress keeps its direction, even if the other direction is shorter.
constexpr double kAmbiguousTurn_deg = 150.0;

constexpr double kLeastSpeed_mps = 1.0;  // [m/s] a slower aircraft has no course
// [turn radii] Distance from a leg up to which a resumed flight goes on along it; else it flies directly to its end.
constexpr double kNearLeg_radii = 4.0;

double turn_radius_m(double speed_mps) {
  return speed_mps * speed_mps / (kGravity_mps2 * std::tan(kPlannedBank.radians()));
}

double approach(double value, double target, double max_change) {
  return value + std::clamp(target - value, -max_change, max_change);
}

Motion start_of(const Route& route, const Leg& leg) {
  const Waypoint& first = route.waypoints.front();
  return {first.point, first.altitude, leg.course_at_start(), first.ground_speed, {}};
}

}  // namespace

RouteFlight::RouteFlight(Route route)
    : route_(std::move(route)), leg_(route_.waypoints[0].point, route_.waypoints[1].point) {
  reset();
}

void RouteFlight::reset() {
  straight_ = false;
  fly_to(1, route_.waypoints[0].point);
  motion_ = start_of(route_, leg_);
  roll_ = {};
}

bool RouteFlight::reposition(const Placement& placement) {
  motion_.point = placement.point;
  motion_.altitude = placement.altitude;
  motion_.track = placement.heading;
  motion_.climb = {};
  roll_ = {};
  fly_to(nearest_leg_end(placement.point), placement.point);
  motion_.ground_speed = placement.ground_speed.value_or(route_.waypoints[target_].ground_speed);
  straight_ = placement.ground_speed.has_value();
  return true;
}

bool RouteFlight::resume(const databuffer::Ownship& last, geo::Duration gap) {
  const double north_mps = last.velocity_north_mps, east_mps = last.velocity_east_mps;
  const Motion motion{{last.latitude_deg, last.longitude_deg},
                      geo::AltitudeMsl::metres(last.altitude_msl_m),
                      geo::Bearing::radians(std::atan2(east_mps, north_mps)),
                      geo::Speed::metres_per_second(std::hypot(north_mps, east_mps)),
                      geo::Speed::metres_per_second(-last.velocity_down_mps)};
  // No route has an aircraft that stands still, and its course would be unknown.
  if (!(motion.ground_speed.metres_per_second() > kLeastSpeed_mps)) return FlightModel::resume(last, gap);
  const std::size_t from = leg_flown(motion);
  const std::size_t to = route_.after(from);
  const Leg leg(route_.waypoints[from].point, route_.waypoints[to].point);
  const geo::Length across = leg.fix(motion.point, {}).across;
  const bool is_near =
      std::abs(across.metres()) < kNearLeg_radii * turn_radius_m(motion.ground_speed.metres_per_second());
  motion_ = motion;
  roll_ = std::clamp(geo::Angle::degrees(last.roll_deg), -kBankLimit, kBankLimit);
  fly_to(to, is_near ? route_.waypoints[from].point : motion.point);
  fix_ = leg_.fix(motion_.point, {});
  step(gap);
  return true;
}

// Index of the waypoint at the start of the leg that the aircraft flies. A leg in another direction than the track
// counts as farther away: by the radius of a turn for each radian.
std::size_t RouteFlight::leg_flown(const Motion& motion) const {
  std::size_t best = 0;
  double best_m = std::numeric_limits<double>::infinity();
  const double radius_m = turn_radius_m(motion.ground_speed.metres_per_second());
  for (std::size_t from = 0; from < route_.waypoints.size(); ++from) {
    const std::size_t to = route_.after(from);
    if (to == route_.waypoints.size()) break;
    const Leg leg(route_.waypoints[from].point, route_.waypoints[to].point);
    const Leg::Fix fix = leg.fix(motion.point, {});
    // An open route ends with straight flight beyond its last waypoint.
    const bool is_last = route_.after(to) == route_.waypoints.size();
    const auto along =
        is_last ? std::max(fix.along, geo::Length()) : std::clamp(fix.along, geo::Length(), leg.length());
    const double distance_m = geo::geodesic_inverse(motion.point, leg.point(along)).distance.metres();
    const double cost_m = distance_m + radius_m * std::abs((fix.course - motion.track).radians());
    if (cost_m >= best_m) continue;
    best = from;
    best_m = cost_m;
  }
  return best;
}

void RouteFlight::fly_to(std::size_t waypoint, geo::GeoPoint from) {
  target_ = waypoint;
  leg_ = Leg(from, route_.waypoints[waypoint].point);
  const std::size_t following = route_.after(waypoint);
  next_.reset();
  if (following < route_.waypoints.size())
    next_.emplace(route_.waypoints[waypoint].point, route_.waypoints[following].point);
  fix_ = {};
}

std::size_t RouteFlight::nearest_leg_end(geo::GeoPoint position) const {
  std::size_t best = 1;
  double best_m = std::numeric_limits<double>::infinity();
  for (std::size_t from = 0; from < route_.waypoints.size(); ++from) {
    const std::size_t to = route_.after(from);
    if (to == route_.waypoints.size()) break;
    const Leg leg(route_.waypoints[from].point, route_.waypoints[to].point);
    const auto along = std::clamp(leg.fix(position, {}).along, geo::Length(), leg.length());
    const double distance_m = geo::geodesic_inverse(position, leg.point(along)).distance.metres();
    // A leg is skipped if the aircraft is already at its end.
    const bool at_end = geo::geodesic_inverse(position, route_.waypoints[to].point).distance.metres() < 1.0;
    if (distance_m < best_m && !at_end) {
      best = to;
      best_m = distance_m;
    }
  }
  return best;
}

FlightSample RouteFlight::step(geo::Duration dt) {
  double remaining_s = std::min(forward_step(dt).seconds(), kMaxFlown.seconds());
  while (remaining_s > 0.0) {
    const double part_s = std::min(remaining_s, kMaxStep_s);
    advance(part_s);
    remaining_s -= part_s;
  }
  return sample_of(motion_, coordinated_attitude(motion_, roll_), "route");
}

void RouteFlight::advance(double dt_s) {
  if (straight_) return move(dt_s);
  fix_ = leg_.fix(motion_.point, fix_.along);
  change_leg_in_time();
  const double bank_deg = commanded_bank().degrees();
  roll_ = geo::Angle::degrees(approach(roll_.degrees(), bank_deg, kRollRate_dps * dt_s));
  change_speeds(dt_s);
  move(dt_s);
}

void RouteFlight::change_leg_in_time() {
  if (!next_ || leg_.length() - fix_.along > lead()) return;
  fly_to(route_.after(target_), route_.waypoints[target_].point);
  fix_ = leg_.fix(motion_.point, {});
}

// Distance before the waypoint at which the turn begins: tangent length of the circle plus half the roll-in distance.
geo::Length RouteFlight::lead() const {
  const double speed_mps = motion_.ground_speed.metres_per_second();
  const double turn_deg = std::abs((next_->course_at_start() - leg_.course_at_end()).degrees());
  const double half_turn_rad = std::min(turn_deg, kMaxLeadTurn_deg) / 2.0 * geo::kRadiansPerDegree;
  const double roll_in_s = std::min(turn_deg, kPlannedBank.degrees()) / kRollRate_dps;
  const double tangent_m = turn_radius_m(speed_mps) * std::tan(half_turn_rad);
  const auto wanted = geo::Length::metres(tangent_m + speed_mps * roll_in_s / 2.0);
  // At most half the length of the shorter leg. With a longer lead, short legs would be skipped.
  return std::min({wanted, 0.5 * leg_.length(), 0.5 * next_->length()});
}

// Commanded angle from the leg to the track, right positive, at most kMaxIntercept_deg. Far from the leg the path is a
// circular arc, which would become parallel to the leg at the distance beside_m. Closer than twice beside_m, the angle
// is proportional to the distance from the leg. At twice beside_m both laws give nearly the same angle.
geo::Angle RouteFlight::intercept() const {
  const double speed_mps = motion_.ground_speed.metres_per_second();
  const double radius_m = turn_radius_m(speed_mps);
  const double capture_m = kCaptureTime_s * speed_mps;
  const double across_m = std::abs(fix_.across.metres());
  const double beside_m = capture_m * capture_m / (2.0 * radius_m);
  const double angle_rad = across_m < 2.0 * beside_m ? across_m / capture_m
                                                     : std::acos(std::max(0.0, 1.0 - (across_m - beside_m) / radius_m));
  const auto angle = std::min(geo::Angle::radians(angle_rad), geo::Angle::degrees(kMaxIntercept_deg));
  return fix_.across > geo::Length() ? -angle : angle;
}

geo::Angle RouteFlight::commanded_bank() const {
  geo::Angle error = fix_.course + intercept() - motion_.track;
  if (std::abs(error.degrees()) > kAmbiguousTurn_deg && std::abs(roll_.degrees()) > 1.0)
    error = geo::Angle::degrees(std::copysign(error.degrees(), roll_.degrees()));
  const double speed_mps = motion_.ground_speed.metres_per_second();
  const auto bank = geo::Angle::radians(std::atan(kTrackGain_per_s * error.radians() * speed_mps / kGravity_mps2));
  return std::clamp(bank, -kBankLimit, kBankLimit);
}

void RouteFlight::change_speeds(double dt_s) {
  const Waypoint& waypoint = route_.waypoints[target_];
  const double max_change_mps = kAcceleration_mps2 * dt_s;
  const double limit_mps = kClimbLimit.metres_per_second();
  const double rise_m = (waypoint.altitude - motion_.altitude).metres();
  const double climb_mps = std::clamp(kClimbGain_per_s * rise_m, -limit_mps, limit_mps);
  motion_.climb = geo::Speed::metres_per_second(approach(motion_.climb.metres_per_second(), climb_mps, max_change_mps));
  motion_.ground_speed = geo::Speed::metres_per_second(
      approach(motion_.ground_speed.metres_per_second(), waypoint.ground_speed.metres_per_second(), max_change_mps));
}

void RouteFlight::move(double dt_s) {
  const double speed_mps = motion_.ground_speed.metres_per_second();
  if (!(speed_mps > 0.0)) return;
  const auto turn = geo::Angle::radians(kGravity_mps2 * std::tan(roll_.radians()) / speed_mps * dt_s);
  // The chord of an arc deviates from the initial track by half the turn. So half the turn is applied before the step,
  // and half after it.
  const geo::Length flown = geo::Length::metres(speed_mps * dt_s);
  const geo::GeodesicRay chord(motion_.point, motion_.track + 0.5 * turn);
  const auto end = chord.position_and_azimuth(surface_distance(motion_, flown));
  motion_.point = end.point;
  motion_.track = end.azimuth + 0.5 * turn;
  motion_.altitude = motion_.altitude + geo::Length::metres(motion_.climb.metres_per_second() * dt_s);
}

}  // namespace yars::flightmodel
