#include "model/hrm/map_movers.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::hrm {

namespace {
constexpr double kLeastDoppler_mps = 1.0;  // of V sin(squint): nearer the track nothing can be mapped anyway

// A weighted copy of the response, its peak at a place between the pixels [pixels].
void splat(const Response& response, double column, double row, double power, MapImage& image) {
  int first_column = 0;
  int first_row = 0;
  const std::vector<float> across = response.weights(column, first_column);
  const std::vector<float> down = response.weights(row, first_row);
  for (std::size_t j = 0; j < down.size(); ++j) {
    const int y = first_row + static_cast<int>(j);
    if (y < 0 || y >= image.size) continue;
    for (std::size_t i = 0; i < across.size(); ++i) {
      const int x = first_column + static_cast<int>(i);
      if (x < 0 || x >= image.size) continue;
      image.power[image.at(x, y)] += static_cast<float>(power) * across[i] * down[j];
    }
  }
}
}  // namespace

MapMovers::MapMovers(const radar::RadarConfiguration& configuration)
    : gas_(configuration), points_(rbm::configured_points(configuration)) {}

MapMovers::Trace MapMovers::trace_of(const rbm::MovingPoint& mover, const PatchOrder& order,
                                     const PatchGeometry& geometry, geo::Duration formation, double height_m) const {
  const double time_s = formation.seconds();
  const MapPoint start = geometry.point_of(mover.place(order.sim_time));
  const MapPoint end = geometry.point_of(mover.place(order.sim_time + formation));
  const MapPoint middle{0.5 * (start.right_m + end.right_m), 0.5 * (start.up_m + end.up_m)};
  const double ahead_m = middle.up_m + geometry.distance_m();
  const double distance_m = std::hypot(middle.right_m, ahead_m);
  // Along and across the line of sight to the target.
  const double out_right = middle.right_m / distance_m;
  const double out_up = ahead_m / distance_m;
  const double speed_right = time_s > 0.0 ? (end.right_m - start.right_m) / time_s : 0.0;
  const double speed_up = time_s > 0.0 ? (end.up_m - start.up_m) / time_s : 0.0;
  const double receding_mps = speed_right * out_right + speed_up * out_up;
  const double crossing_mps = speed_right * out_up - speed_up * out_right;

  const double squint_rad = geometry.squint(order.ground_track).radians() + std::atan2(middle.right_m, ahead_m);
  const double doppler_mps = order.ground_speed.metres_per_second() * std::sin(squint_rad);
  const double steady_mps = std::copysign(std::max(std::abs(doppler_mps), kLeastDoppler_mps), doppler_mps);
  // Looking right (positive squint) forwards is left on the map.
  const double shift_m = receding_mps / steady_mps * distance_m;
  const double seen_m = laid_over_m(distance_m, height_m, geometry.above_level_m(distance_m)) - distance_m;
  const MapPoint shown{middle.right_m + out_right * seen_m + out_up * shift_m,
                       middle.up_m + out_up * seen_m - out_right * shift_m};
  // What it goes outwards walks in range; what it goes across defocuses it in azimuth, twice its way.
  const double walk_m = receding_mps * time_s;
  const double blur_m = 2.0 * std::abs(crossing_mps) * time_s;
  const MapPoint half{0.5 * (out_right * walk_m + out_up * blur_m), 0.5 * (out_up * walk_m - out_right * blur_m)};
  return {{shown.right_m - half.right_m, shown.up_m - half.up_m},
          {shown.right_m + half.right_m, shown.up_m + half.up_m}};
}

bool MapMovers::hidden(const PatchGeometry& geometry, const Horizons& horizons, MapPoint point, double height_m) const {
  const FanGrid& grid = *horizons.grid;
  const double ahead_m = point.up_m + geometry.distance_m();
  const double distance_m = std::hypot(point.right_m, ahead_m);
  const int column = static_cast<int>(std::lround((point.right_m / ahead_m - grid.first_tangent) / grid.tangent_step));
  const int row = static_cast<int>(std::floor((distance_m - grid.first_distance_m) / grid.spacing_m));
  if (!(ahead_m > 0.0) || column < 0 || column >= grid.columns || row < 0) return false;
  const double tangent = (height_m - geometry.above_plane_m(distance_m)) / distance_m;
  double horizon = static_cast<double>(horizons.horizon[column]);
  for (int i = 0; i < std::min(row, grid.rows); ++i) {
    const double there_m = grid.distance_m(i);
    const std::size_t at = grid.at(column, i);
    float top_m = horizons.surface[at].height_m;
    if (horizons.crest_m != nullptr) top_m = std::max(top_m, horizons.crest_m[at]);
    const double raised = (static_cast<double>(top_m) - geometry.above_plane_m(there_m)) / there_m;
    horizon = std::max(horizon, raised);
  }
  return tangent < horizon;
}

void MapMovers::draw(const PatchOrder& order, const PatchGeometry& geometry, geo::Duration formation,
                     const rbm::Database& database, const Horizons& horizons, const Response& response,
                     MapImage& image) const {
  for (const std::span<const rbm::MovingPoint> points : {std::span(points_), database.traffic})
    for (const rbm::MovingPoint& mover : points)
      draw_point(mover, order, geometry, formation, database.terrain, horizons, response, image);
}

void MapMovers::draw_point(const rbm::MovingPoint& mover, const PatchOrder& order, const PatchGeometry& geometry,
                           geo::Duration formation, const terrain::TerrainView& terrain, const Horizons& horizons,
                           const Response& response, MapImage& image) const {
  const double pixel_m = geometry.window_m() / image.size;
  const geo::GeoPoint place = mover.place(order.sim_time);
  const MapPoint point = geometry.point_of(place);
  // Far outside it costs no more than this; displacement may bring it in from about a window away.
  if (std::hypot(point.right_m, point.up_m) > 2.0 * geometry.window_m()) return;
  const double ground_m = terrain.elevation_m(place);
  if (std::isnan(ground_m)) return;
  const double height_m = ground_m + mover.height_m - geometry.plane_msl_m();
  if (hidden(geometry, horizons, point, height_m)) return;
  const Trace trace = trace_of(mover, order, geometry, formation, height_m);
  const double length_m = std::hypot(trace.to.right_m - trace.from.right_m, trace.to.up_m - trace.from.up_m);
  const int steps = 1 + static_cast<int>(std::min(std::ceil(length_m / pixel_m), 4.0 * image.size));
  const double distance_m = std::hypot(point.right_m, point.up_m + geometry.distance_m());
  const double loss = gas_.two_way_loss(geometry.earth(), geometry.altitude_m(), distance_m, ground_m);
  const double power = loss * mover.cross_section_m2 / (unit_return_m2(geometry, image.size) * steps);
  for (int step = 0; step < steps; ++step) {
    const double share = (step + 0.5) / steps;
    const double right_m = trace.from.right_m + share * (trace.to.right_m - trace.from.right_m);
    const double up_m = trace.from.up_m + share * (trace.to.up_m - trace.from.up_m);
    splat(response, right_m / pixel_m + 0.5 * image.size - 0.5, 0.5 * image.size - 0.5 - up_m / pixel_m, power, image);
  }
}

}  // namespace yars::model::hrm
