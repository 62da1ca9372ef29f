#include "model/physics/environment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/radar/fidelity.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

namespace {
constexpr double kMaxRun_m = 100.0;  // a mover's fix is renewed after this distance

geo::Vector3 on_ellipsoid(geo::GeoPoint position) {
  return geo::ecef_from_geodetic(position, geo::HeightAboveEllipsoid::metres(0.0));
}
}  // namespace

MovingPoint moving_point(const Course& course, const PointTarget& target, double height_m) {
  return {geo::GeodesicRay(course.start, course.heading),
          course.speed_mps,
          target,
          height_m,
          course.since,
          on_ellipsoid(course.start)};
}

std::vector<MovingPoint> moving_points(const radar::WorldConfiguration& world) {
  std::vector<MovingPoint> points;
  for (const radar::Mover& mover : world.movers)
    points.push_back(moving_point(
        {mover.position, geo::Bearing::degrees(mover.heading_deg), mover.speed_mps, mover.since},
        {mover.cross_section_m2, mover.echo, points.size(), mover.facing_deg, mover.tilt_deg}, mover.height_m));
  return points;
}

Movers::Movers(const RadarParameters& parameters)
    : exact_(parameters.fidelity.algorithm == radar::Algorithm::reference),
      beam_(parameters.beam),
      gas_(parameters),
      target_echoes_(parameters),
      sea_mirror_(parameters) {
  use_movers(parameters);
}

void Movers::use_movers(const RadarParameters& parameters) {
  points_ = moving_points(parameters.world);
  fixes_.clear();
  echoes_.clear();
  for (const MovingPoint& point : points_) fixes_.push_back({point.start_ecef, point.since});
  echoes_.reserve(points_.size() + kMaxTraffic);
}

// The sector of the beam up to the range, seen from above. It is tested before the exact position of a mover is
// computed, which takes a thousand times as long.
class Movers::Sector {
 public:
  Sector(const SweepGeometry& geometry, double beamwidth_rad)
      : apex_(on_ellipsoid(geometry.apex)), range_m_(geometry.range.metres()) {
    const geo::LocalTangentFrame level(geometry.apex, geo::HeightAboveEllipsoid::metres(0.0));
    const AzimuthInterval interval = point_interval(geometry.sharpened_cell, beamwidth_rad);
    narrow_ = interval.left_rad > -kMaxSide_rad && interval.right_rad < kMaxSide_rad;
    const auto across = [&](double offset_rad) {
      const double azimuth_rad = geometry.azimuth.radians() + offset_rad;
      return level.ecef_from_enu_direction({std::cos(azimuth_rad), -std::sin(azimuth_rad), 0.0});
    };
    const double azimuth_rad = geometry.azimuth.radians();
    ahead_ = level.ecef_from_enu_direction({std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0});
    right_ = across(0.0);
    curvature_m_ = geo::radius_of_curvature(geometry.apex.latitude_deg, geometry.azimuth).metres();
    right_of_left_ = across(interval.left_rad);
    right_of_right_ = across(interval.right_rad);
  }

  // Distance over ground and azimuth off the ray; empty if the point is too far for the series.
  struct Path {
    double distance_m, offset_rad;
  };
  std::optional<Path> path_to(geo::GeoPoint position) const {
    const geo::Vector3 to_point = on_ellipsoid(position) - apex_;
    if (dot(to_point, to_point) > kMaxPlane_m * kMaxPlane_m) return std::nullopt;
    const double ahead_m = dot(to_point, ahead_), right_m = dot(to_point, right_);
    const double plane2 = ahead_m * ahead_m + right_m * right_m;
    return Path{std::sqrt(plane2) * arc_per_plane(plane2, curvature_m_), std::atan2(right_m, ahead_m)};
  }

  // False if no point at most `radius_m` from a position is in the sector.
  bool may_contain(geo::Vector3 ecef, double radius_m) const {
    const geo::Vector3 to_point = ecef - apex_;
    const double square = dot(to_point, to_point);
    // A geodesic and the vertical plane through its start differ by less than kTurn_rad within kMaxPlane_m.
    const double margin_m = radius_m + kMargin_m + kTurn_rad * range_m_;
    const double farthest_m = range_m_ + margin_m;
    if (square > farthest_m * farthest_m) return false;
    return !narrow_ || square > kMaxPlane_m * kMaxPlane_m ||
           (dot(to_point, right_of_left_) >= -margin_m && dot(to_point, right_of_right_) <= margin_m);
  }

 private:
  static constexpr double kMaxSide_rad = 1.5;  // the two sides of a narrow sector lie ahead
  static constexpr double kMargin_m = 1.0;
  static constexpr double kTurn_rad = 1e-4;
  static constexpr double kMaxPlane_m = 1'852'000.0;
  geo::Vector3 apex_, ahead_, right_, right_of_left_, right_of_right_;  // ECEF
  double curvature_m_ = 0.0;                                            // radius of the ellipsoid's curvature
  double range_m_;
  bool narrow_;
};

std::span<const Echo> Movers::echoes(const SweepGeometry& geometry, const Receiver& receiver,
                                     const EffectiveEarth& earth, const Environment& environment) {
  echoes_.clear();
  const auto traffic = environment.traffic.first(std::min(environment.traffic.size(), kMaxTraffic));
  if (points_.empty() && traffic.empty()) return echoes_;
  const AzimuthInterval interval = point_interval(geometry.sharpened_cell, receiver.azimuth_beamwidth_rad);
  if (!(interval.left_rad < interval.right_rad)) return echoes_;
  const Sector sector(geometry, receiver.azimuth_beamwidth_rad);
  const Sweep sweep{geometry, receiver, earth, environment.terrain, environment.scan};
  const auto run_m = [&](const MovingPoint& point, geo::Duration since) {
    return point.speed_mps * std::abs((geometry.sim_time - since).seconds());
  };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Fix& fix = fixes_[i];
    if (run_m(points_[i], fix.time) > kMaxRun_m)
      fix = {on_ellipsoid(points_[i].position(geometry.sim_time)), geometry.sim_time};
    if (sector.may_contain(fix.ecef, run_m(points_[i], fix.time))) add_echo(i, points_[i], sector, sweep);
  }
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    const MovingPoint& point = traffic[i];
    if (sector.may_contain(point.start_ecef, run_m(point, point.since)))
      add_echo(points_.size() + i, point, sector, sweep);
  }
  return echoes_;
}

void Movers::add_echo(std::size_t number, const MovingPoint& point, const Sector& sector, const Sweep& sweep) {
  const auto& [geometry, receiver, earth, terrain, scan] = sweep;
  const geo::GeoPoint position = point.position(geometry.sim_time);
  std::optional<Sector::Path> path;
  if (!exact_) path = sector.path_to(position);
  if (!path) {
    const geo::GeodesicInverse geodesic = geo::geodesic_inverse(geometry.apex, position);
    path = {geodesic.distance.metres(), (geodesic.azimuth_at_start - geometry.azimuth).radians()};
  }
  const auto [distance_m, offset_rad] = *path;
  if (distance_m >= geometry.range.metres() || distance_m <= 0.0) return;
  const double gain_across = point_azimuth_gain(geometry.sharpened_cell, receiver.azimuth_beamwidth_rad, offset_rad);
  if (!(gain_across > 0.0)) return;
  const double ground_m = terrain.elevation_m(position);
  const double height_m = (std::isnan(ground_m) ? 0.0 : ground_m) + point.height_m;
  const Sight sight = earth.sight(geometry.altitude.metres(), distance_m, height_m);
  const double gain = gain_across * two_way_gain(beam_, receiver.elevation_beamwidth_rad, geometry.elevation.radians(),
                                                 sight.elevation_rad);
  const double loss = gas_.two_way_transmission(earth, geometry.altitude.metres(), distance_m, height_m);
  const double cross_section_m2 = target_echoes_.cross_section_m2(
      point.target, scan, [&, apex = geometry.apex] { return aspect_of(position, apex, sight); });
  // Only a target over water has lobes. `water` of its own position stands for that of the reflection.
  const bool lobes = sea_mirror_.works() && terrain.surface_at(position, radar::Interpolation::nearest).water > 0.5;
  const double factor =
      lobes ? sea_mirror_.lobe_factor(earth, geometry.altitude.metres(), distance_m, point.height_m) : 1.0;
  const double power = returned_power(cross_section_m2, factor * loss * gain, sight.slant_range_m);
  echoes_.push_back({number, position, point.height_m, distance_m, sight.slant_range_m, offset_rad,
                     received(receiver, power, sight.slant_range_m)});
}

namespace {
// Of the samples beside a target, the nearest one. `index`: number of nearer samples.
std::size_t nearest_of(std::span<const double> distance_m, double target_m, std::size_t index) {
  if (index > 0 && !std::isnan(distance_m[index - 1])) {
    const bool nearer = index == distance_m.size() || target_m - distance_m[index - 1] < distance_m[index] - target_m;
    if (nearer) --index;
  }
  return index;
}
}  // namespace

std::size_t samples_nearer(std::span<const double> distance_m, double target_m, std::size_t guess) {
  std::size_t count = std::min(guess, distance_m.size());
  while (count > 0 && distance_m[count - 1] >= target_m) --count;
  while (count < distance_m.size() && !(distance_m[count] >= target_m)) ++count;
  return count;
}

std::size_t samples_nearer(std::span<const double> distance_m, double target_m) {
  const auto is_nearer = [target_m](double centre_m) { return !(centre_m >= target_m); };
  const auto count = static_cast<std::ptrdiff_t>(distance_m.size());
  // Centres are mostly evenly spaced. So a guess is often right, or the next one is.
  if (count > 1) {
    const double first_m = distance_m.front(), step_m = (distance_m.back() - first_m) / static_cast<double>(count - 1);
    const double guess = (target_m - first_m) / step_m;
    if (guess > 0.0 && guess < static_cast<double>(count - 1)) {
      const auto below = static_cast<std::ptrdiff_t>(guess);
      for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(below, 1); i <= std::min(below + 2, count - 1); ++i)
        if (is_nearer(distance_m[static_cast<std::size_t>(i - 1)]) &&
            !is_nearer(distance_m[static_cast<std::size_t>(i)]))
          return static_cast<std::size_t>(i);
    }
  }
  return static_cast<std::size_t>(std::partition_point(distance_m.begin(), distance_m.end(), is_nearer) -
                                  distance_m.begin());
}

std::size_t nearest_sample(std::span<const double> distance_m, double target_m) {
  return nearest_of(distance_m, target_m, samples_nearer(distance_m, target_m));
}

std::size_t nearest_sample(std::span<const double> distance_m, double target_m, std::size_t guess) {
  return nearest_of(distance_m, target_m, samples_nearer(distance_m, target_m, guess));
}

}  // namespace yars::model::physics
