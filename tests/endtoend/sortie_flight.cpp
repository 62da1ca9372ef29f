#include "tests/endtoend/sortie_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "lib/geo/geodesy.hpp"

namespace yars::endtoend {

namespace {

using std::numbers::pi;

constexpr geo::GeoPoint kRunway{37.475, -122.608};  // middle of the runway, which runs from west to east
constexpr double kStep_s = 0.25;
constexpr double kGravity_mps2 = 9.80665;
constexpr double kAntennaAboveWheels_m = 2.5;

struct Knot {
  double time_s;
  double value;
};
// [m/s] speed, linear between the knots: take-off run, flight, deceleration for the approach, touch-down, landing run.
constexpr std::array kSpeed{Knot{6.0, 0.0},    Knot{39.25, 200.0}, Knot{150.0, 200.0},
                            Knot{200.0, 78.0}, Knot{230.0, 78.0},  Knot{254.0, 0.0}};
// [m] height above the runway, smooth between the knots: lift-off at 90 m/s, climb, descent, flare.
constexpr std::array kHeight{Knot{21.0, 0.0}, Knot{70.0, 3000.0}, Knot{125.0, 3000.0}, Knot{200.0, 140.0},
                             Knot{230.0, 0.0}};

// Fraction 0..1 of the time between two knots.
double fraction_at(const Knot& from, const Knot& to, double time_s) {
  return std::clamp((time_s - from.time_s) / (to.time_s - from.time_s), 0.0, 1.0);
}

double speed_mps(double time_s) {
  double speed = kSpeed.front().value;
  for (std::size_t i = 1; i < kSpeed.size(); ++i)
    speed += (kSpeed[i].value - kSpeed[i - 1].value) * fraction_at(kSpeed[i - 1], kSpeed[i], time_s);
  return speed;
}

double height_m(double time_s) {
  double height = kHeight.front().value;
  for (std::size_t i = 1; i < kHeight.size(); ++i) {
    const double fraction = fraction_at(kHeight[i - 1], kHeight[i], time_s);
    height += (kHeight[i].value - kHeight[i - 1].value) * fraction * fraction * (3.0 - 2.0 * fraction);
  }
  return height;
}

// A straight line or an arc of the path.
struct Leg {
  double length_m;
  double turn_rad = 0.0;  // change of the track, positive to the right; 0: straight line
};

// Position relative to the middle of the runway, and track clockwise from north.
struct PathPoint {
  double east_m;
  double north_m;
  double track_rad;
};

// The path of length `path_m`: east, a half circle to the right, west, an S-shaped shift to the right onto the centre
// line of the runway, final approach and landing run to the stop.
std::vector<Leg> legs(double path_m) {
  constexpr double kTurnRadius_m = 1500.0, kJoinRadius_m = 3000.0, kFinal_m = 3150.0;
  constexpr double kStart_m = -1250.0, kStop_m = -300.0;  // east of the runway's middle
  const double half_circle_m = pi * kTurnRadius_m, arc_m = kJoinRadius_m * pi / 3.0;
  // Two opposite arcs of 60 deg shift the path sideways by their radius, which is the diameter of the half circle.
  const double join_east_m = 2.0 * kJoinRadius_m * std::sin(pi / 3.0);
  // The lengths of the two long straight lines follow from their sum and their difference.
  const double sum_m = path_m - half_circle_m - 2.0 * arc_m - kFinal_m;
  const double difference_m = kStop_m - kStart_m + join_east_m + kFinal_m;
  return {{(sum_m + difference_m) / 2.0},
          {half_circle_m, pi},
          {(sum_m - difference_m) / 2.0},
          {arc_m, pi / 3.0},
          {arc_m, -pi / 3.0},
          {kFinal_m}};
}

PathPoint place_after(const std::vector<Leg>& path, double flown_m) {
  PathPoint place{-1250.0, 0.0, pi / 2.0};
  for (const Leg& leg : path) {
    const double length_m = std::min(flown_m, leg.length_m);
    const double turned_rad = leg.turn_rad * length_m / leg.length_m;
    // The bearing of an arc's chord is the mean of the bearings of its two ends.
    const double half_rad = turned_rad / 2.0;
    const double chord_m = half_rad == 0.0 ? length_m : length_m * std::sin(half_rad) / half_rad;
    place.east_m += chord_m * std::sin(place.track_rad + half_rad);
    place.north_m += chord_m * std::cos(place.track_rad + half_rad);
    place.track_rad += turned_rad;
    flown_m -= length_m;
  }
  return place;
}

geo::GeoPoint on_earth(const PathPoint& place) {
  return geo::geodesic_direct(kRunway, geo::Bearing::radians(std::atan2(place.east_m, place.north_m)),
                              geo::Length::metres(std::hypot(place.east_m, place.north_m)));
}

// True heading [deg] from one row to the next; `standing_deg` while the aircraft stands still.
double heading_deg(geo::GeoPoint from, geo::GeoPoint to, double standing_deg) {
  const auto line = geo::geodesic_inverse(from, to);
  return line.distance.metres() < 1e-3 ? standing_deg : line.azimuth_at_start.degrees();
}

}  // namespace

std::string sortie_track() {
  std::vector<double> flown_m{0.0};
  for (double time_s = 0.0; time_s < kSortie_s; time_s += kStep_s)
    flown_m.push_back(flown_m.back() + kStep_s * speed_mps(time_s + kStep_s / 2.0));
  const std::vector<Leg> path = legs(flown_m.back());
  std::string rows = "time,lat,lon,alt_ft,heading,pitch,roll\n";
  // The roll angle follows the bank of a coordinated turn with a time constant of 1 s, so that it has no steps.
  double roll_rad = 0.0, heading = 90.0;
  for (std::size_t row = 0; row + 1 < flown_m.size(); ++row) {
    const double time_s = static_cast<double>(row) * kStep_s, speed = speed_mps(time_s);
    const PathPoint here = place_after(path, flown_m[row]), next = place_after(path, flown_m[row + 1]);
    const double turn_rate = (next.track_rad - here.track_rad) / kStep_s;
    roll_rad += (std::atan(speed * turn_rate / kGravity_mps2) - roll_rad) * kStep_s;
    const double climb_mps = (height_m(time_s + kStep_s) - height_m(time_s)) / kStep_s;
    const double pitch_rad = speed > 1.0 ? std::atan(climb_mps / speed) : 0.0;
    heading = heading_deg(on_earth(here), on_earth(next), heading);
    const geo::GeoPoint point = on_earth(here);
    const double altitude_ft = (kRunwayElevation_m + kAntennaAboveWheels_m + height_m(time_s)) / geo::kMetresPerFoot;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%.2f,%.9f,%.9f,%.3f,%.5f,%.4f,%.4f\n", time_s, point.latitude_deg,
                  point.longitude_deg, altitude_ft, heading, pitch_rad / geo::kRadiansPerDegree,
                  roll_rad / geo::kRadiansPerDegree);
    rows += text.data();
  }
  return rows;
}

}  // namespace yars::endtoend
