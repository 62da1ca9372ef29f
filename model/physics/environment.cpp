#include "model/physics/environment.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/earth.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

std::vector<MovingPoint> configured_points(const RadarParameters& parameters) {
  std::vector<MovingPoint> points;
  for (const radar::Mover& mover : parameters.world.movers)
    points.push_back({geo::GeodesicRay(mover.position, geo::Bearing::degrees(mover.heading_deg)),
                      mover.speed_mps,
                      mover.cross_section_m2,
                      mover.height_m,
                      {}});
  return points;
}

Movers::Movers(const RadarParameters& parameters)
    : beam_(parameters.beam), gas_(parameters), points_(configured_points(parameters)) {
  echoes_.reserve(points_.size() + kMaxTraffic);
}

std::span<const Echo> Movers::echoes(const SweepGeometry& geometry, const Receiver& receiver,
                                     const EffectiveEarth& earth, const Environment& environment) {
  echoes_.clear();
  add_echoes(points_, geometry, receiver, earth, environment.terrain);
  add_echoes(environment.traffic.first(std::min(environment.traffic.size(), kMaxTraffic)), geometry, receiver, earth,
             environment.terrain);
  return echoes_;
}

void Movers::add_echoes(std::span<const MovingPoint> points, const SweepGeometry& geometry, const Receiver& receiver,
                        const EffectiveEarth& earth, const terrain::TerrainView& terrain) {
  for (const MovingPoint& point : points) {
    const geo::GeoPoint position = point.position(geometry.sim_time);
    if (std::abs(position.latitude_deg - geometry.apex.latitude_deg) * geo::kMinMetresPerDegree >
        geometry.range.metres())
      continue;
    const geo::GeodesicInverse path = geo::geodesic_inverse(geometry.apex, position);
    const double offset_rad = (path.azimuth_at_start - geometry.azimuth).radians();
    const double distance_m = path.distance.metres();
    if (distance_m >= geometry.range.metres() || distance_m <= 0.0) continue;
    const double gain_across = point_azimuth_gain(geometry.slice, receiver.azimuth_beamwidth_rad, offset_rad);
    if (!(gain_across > 0.0)) continue;
    const double ground_m = terrain.elevation_m(position);
    const double height_m = (std::isnan(ground_m) ? 0.0 : ground_m) + point.height_m;
    const Sight sight = earth.sight(geometry.altitude.metres(), distance_m, height_m);
    const double gain = gain_across * two_way_gain(beam_, receiver.elevation_beamwidth_rad,
                                                   geometry.elevation.radians(), sight.elevation_rad);
    const double loss = gas_.two_way_transmission(earth, geometry.altitude.metres(), distance_m, height_m);
    const double power = returned_power(point.cross_section_m2, loss * gain, sight.slant_range_m);
    echoes_.push_back({distance_m, sight.tangent, received(receiver, power, sight.slant_range_m)});
  }
}

std::size_t samples_nearer(std::span<const double> distance_m, double target_m) {
  const auto first_not_nearer = std::partition_point(distance_m.begin(), distance_m.end(),
                                                     [target_m](double centre_m) { return !(centre_m >= target_m); });
  return static_cast<std::size_t>(first_not_nearer - distance_m.begin());
}

std::size_t nearest_sample(std::span<const double> distance_m, double target_m) {
  std::size_t index = samples_nearer(distance_m, target_m);
  if (index > 0 && !std::isnan(distance_m[index - 1])) {
    const bool nearer = index == distance_m.size() || target_m - distance_m[index - 1] < distance_m[index] - target_m;
    if (nearer) --index;
  }
  return index;
}

}  // namespace yars::model::physics
