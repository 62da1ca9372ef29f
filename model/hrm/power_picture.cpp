#include "model/hrm/power_picture.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "lib/radar/fidelity.hpp"
#include "lib/radar/mission.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

namespace {
constexpr double kMinDoppler_mps = 1.0;  // [m/s] lower bound of V |sin(squint)|, which is a divisor

// Adds the response of a point at a fractional position [pixels].
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
      const float added = static_cast<float>(power) * across[i] * down[j];
      const std::size_t pixel = image.at(x, y);
      image.power[pixel] += added;
      image.steady.push_back({static_cast<std::uint32_t>(pixel), added});
    }
  }
}
}  // namespace

MapMovers::MapMovers(const physics::RadarParameters& parameters)
    : gas_(parameters), target_echoes_(parameters), points_(physics::moving_points(parameters.world)) {}

MapMovers::Trace MapMovers::trace_of(const physics::MovingPoint& mover, const PatchOrder& order,
                                     const PatchGeometry& geometry, geo::Duration formation, double height_m) const {
  const double time_s = formation.seconds();
  const MapPoint start = geometry.point_of(mover.position(order.sim_time));
  const MapPoint end = geometry.point_of(mover.position(order.sim_time + formation));
  const MapPoint middle{0.5 * (start.right_m + end.right_m), 0.5 * (start.up_m + end.up_m)};
  const double ahead_m = middle.up_m + geometry.distance_m();
  const double distance_m = std::hypot(middle.right_m, ahead_m);
  // Unit vector along the line of sight, then radial and cross-range speeds of the target.
  const double out_right = middle.right_m / distance_m;
  const double out_up = ahead_m / distance_m;
  const double speed_right = time_s > 0.0 ? (end.right_m - start.right_m) / time_s : 0.0;
  const double speed_up = time_s > 0.0 ? (end.up_m - start.up_m) / time_s : 0.0;
  const double receding_mps = speed_right * out_right + speed_up * out_up;
  const double crossing_mps = speed_right * out_up - speed_up * out_right;

  const double squint_rad = geometry.squint(order.ground_track).radians() + std::atan2(middle.right_m, ahead_m);
  const double doppler_mps = order.ground_speed.metres_per_second() * std::sin(squint_rad);
  const double clamped_doppler_mps = std::copysign(std::max(std::abs(doppler_mps), kMinDoppler_mps), doppler_mps);
  // With positive squint the map is right of the track, and the aircraft flies to the left on the map. A receding
  // target is shifted aft, to the right.
  const double shift_m = receding_mps / clamped_doppler_mps * distance_m;
  const double layover_m = laid_over_m(distance_m, height_m, geometry.above_level_m(distance_m)) - distance_m;
  const MapPoint shown{middle.right_m + out_right * layover_m + out_up * shift_m,
                       middle.up_m + out_up * layover_m - out_right * shift_m};
  // Radial motion smears in range (range walk). Cross-range motion smears in azimuth by twice the distance moved.
  const double walk_m = receding_mps * time_s;
  const double blur_m = 2.0 * std::abs(crossing_mps) * time_s;
  const MapPoint half{0.5 * (out_right * walk_m + out_up * blur_m), 0.5 * (out_up * walk_m - out_right * blur_m)};
  return {{shown.right_m - half.right_m, shown.up_m - half.up_m},
          {shown.right_m + half.right_m, shown.up_m + half.up_m}};
}

bool MapMovers::hidden(const PatchGeometry& geometry, const Horizons& horizons, const Target& target) const {
  const PolarGrid& grid = *horizons.grid;
  const auto tangent_of = [&](double distance_m, double height_m) {
    const auto [above_m, sight_m] = geometry.plane_sight(distance_m);
    return (height_m - above_m) / sight_m;
  };
  const double tangent = tangent_of(target.distance_m(), target.height_m);
  double horizon = static_cast<double>(horizons.horizon[target.column]);
  for (int i = 0; i < std::min(target.row, grid.rows); ++i) {
    const std::size_t at = grid.at(target.column, i);
    float top_m = horizons.surface[at].height_m;
    if (horizons.crest_m != nullptr) top_m = std::max(top_m, horizons.crest_m[at]);
    horizon = std::max(horizon, tangent_of(grid.distance_m(i), static_cast<double>(top_m)));
  }
  return tangent < horizon;
}

void MapMovers::begin(const PatchOrder& order, const PatchGeometry& geometry, const PolarGrid& grid,
                      const PatchEnvironment& environment) {
  targets_.clear();
  const std::vector<physics::MovingPoint>& movers = environment.movers ? *environment.movers : points_;
  for (const auto* points : {&movers, &environment.traffic})
    for (const physics::MovingPoint& mover : *points)
      if (auto target = find_target(mover, order.sim_time, geometry, *environment.window)) {
        place_on_grid(grid, *target);
        targets_.push_back(*target);
      }
}

std::optional<MapMovers::Target> MapMovers::find_target(const physics::MovingPoint& mover, geo::Duration sim_time,
                                                        const PatchGeometry& geometry,
                                                        const terrain::TerrainView& terrain) {
  const geo::GeoPoint position = mover.position(sim_time);
  const MapPoint point = geometry.point_of(position);
  // Displacement can move a point into the picture from about one window away. Points more than two windows from the
  // centre are skipped.
  if (std::hypot(point.right_m, point.up_m) > 2.0 * geometry.window_m()) return std::nullopt;
  const double ground_m = terrain.elevation_m(position);
  if (std::isnan(ground_m)) return std::nullopt;
  return Target{&mover, point.right_m, point.up_m + geometry.distance_m(), ground_m,
                ground_m + mover.height_m - geometry.plane_msl_m()};
}

void MapMovers::place_on_grid(const PolarGrid& grid, Target& target) {
  if (!(target.ahead_m > 0.0)) return;
  target.row = static_cast<int>(std::floor((target.distance_m() - grid.first_distance_m) / grid.spacing_m));
  const auto column =
      static_cast<int>(std::lround((target.right_m / target.ahead_m - grid.first_tangent) / grid.tangent_step));
  if (column >= 0 && column < grid.columns && target.row >= 0) target.column = column;
}

void MapMovers::find_hidden(const PatchGeometry& geometry, const Horizons& horizons) {
  const PolarGrid& grid = *horizons.grid;
  for (Target& target : targets_)
    if (target.column >= grid.first_drawn_column() && target.column < grid.end_drawn_column())
      target.hidden = hidden(geometry, horizons, target);
}

void MapMovers::draw(const PatchOrder& order, const PatchGeometry& geometry, geo::Duration formation,
                     const Response& response, MapImage& image) const {
  image.steady.clear();
  for (const Target& target : targets_)
    if (!target.hidden) draw_point(target, order, geometry, formation, response, image);
  std::ranges::stable_sort(image.steady, {}, &physics::SteadyPower::at);
}

void MapMovers::draw_point(const Target& target, const PatchOrder& order, const PatchGeometry& geometry,
                           geo::Duration formation, const Response& response, MapImage& image) const {
  const double pixel_m = geometry.window_m() / image.size;
  const Trace trace = trace_of(*target.mover, order, geometry, formation, target.height_m);
  const double length_m = std::hypot(trace.to.right_m - trace.from.right_m, trace.to.up_m - trace.from.up_m);
  const int steps = 1 + static_cast<int>(std::min(std::ceil(length_m / pixel_m), 4.0 * image.size));
  const double loss =
      gas_.two_way_transmission(geometry.earth(), geometry.altitude_m(), target.distance_m(), target.ground_m);
  const double cross_section_m2 = target_echoes_.cross_section_m2(target.mover->target, order.map, [&] {
    const double height_msl_m = target.height_m + geometry.plane_msl_m();
    const physics::Sight sight = geometry.earth().sight(geometry.altitude_m(), target.distance_m(), height_msl_m);
    return physics::aspect_of(target.mover->position(order.sim_time), order.apex, sight);
  });
  const double power = loss * cross_section_m2 / (unit_return_m2(geometry, image.size) * steps);
  for (int step = 0; step < steps; ++step) {
    const double fraction = (step + 0.5) / steps;
    const double right_m = trace.from.right_m + fraction * (trace.to.right_m - trace.from.right_m);
    const double up_m = trace.from.up_m + fraction * (trace.to.up_m - trace.from.up_m);
    splat(response, right_m / pixel_m + 0.5 * image.size - 0.5, 0.5 * image.size - 0.5 - up_m / pixel_m, power, image);
  }
}

PowerPicture::PowerPicture(const physics::RadarParameters& parameters)
    : high_resolution_(parameters.high_resolution),
      seed_(parameters.seed),
      with_speckle_(parameters.fidelity.noise),
      with_response_(parameters.fidelity.map_response),
      movers_(parameters),
      response_(parameters.high_resolution.sidelobe_db,
                static_cast<double>(radar::kMapCells) / std::max(parameters.fidelity.map_size, 1)) {}

double PowerPicture::thermal_noise(const PatchInputs& inputs, const PatchData& data) const {
  return noise_gamma(high_resolution_, geo::Length::metres(data.geometry->slant_range_m()), inputs.order.window);
}

void PowerPicture::find_hidden_points(const PatchInputs& inputs, const PatchData& data) {
  if (data.grid.first_strip == 0) movers_.begin(inputs.order, *data.geometry, data.grid, inputs.environment);
  movers_.find_hidden(*data.geometry, {&data.grid, data.surface.data(), data.crests_m(), data.horizon.data()});
}

void PowerPicture::add_response_and_movers(const PatchInputs& inputs, PatchData& data) {
  // Power below the greater of thermal noise and black level is invisible.
  const radar::HighResolutionConfiguration& hrm = high_resolution_;
  const double black = physics::ratio(hrm.brightest_gamma_db - hrm.dynamic_range_db);
  const double floor = std::max(thermal_noise(inputs, data), black);
  if (with_response_) response_.apply(static_cast<float>(floor), inputs.executor, data.image);
  movers_.draw(inputs.order, *data.geometry, data.formation, response_, data.image);
}

void PowerPicture::draw_video(const PatchInputs& inputs, PatchData& data) const {
  const MapNoise noise{thermal_noise(inputs, data), inputs.order.looks, inputs.order.map, seed_, with_speckle_};
  data.picture.resize(data.image.power.size());
  constexpr int kRowsPerTask = 128;  // each task draws two rows of speckle cells again, so smaller tasks cost more time
  parallel::parallel_for(inputs.executor, data.image.size, kRowsPerTask, [&](int first, int last, std::size_t) {
    form_video(high_resolution_, data.image, noise, first, last, data.picture);
  });
}

}  // namespace yars::model::hrm
