// Forms one patch map of given ground and scene, for tests of the computation from order to picture.
#pragma once

#include <memory>
#include <thread>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/terrain/sampling/analytic_terrain.hpp"

namespace yars::test {

namespace hrm = model::hrm;

inline constexpr geo::GeoPoint kTarget{37.8, -122.3};
inline constexpr double kGround_m = 50.0;  // [m MSL] above 0, because ground at 0 m is water

// Configuration on a flat earth without gases, ground detail, impulse response and noise. `size`: pixels per side.
inline radar::RadarConfiguration bare_map(int size = 480) {
  radar::RadarConfiguration configuration;
  configuration.world.atmosphere.gases = false;  // no attenuation
  configuration.fidelity.earth = radar::EarthModel::flat;
  configuration.fidelity.map_size = size;
  configuration.fidelity.map_response = false;
  configuration.fidelity.map_detail = false;
  configuration.fidelity.map_double_bounce = false;
  configuration.fidelity.noise = false;
  return configuration;
}

struct Viewpoint {
  double from_deg = 180.0;  // true bearing from the target to the aircraft
  double distance_m = 20000.0;
  double above_m = 3000.0;  // above the ground
  double window_m = 0.67 * geo::kMetresPerNauticalMile;
  geo::GeoPoint target = kTarget;
};

// Order of a map at broadside: the target is 90 degrees to the right of the ground track.
inline hrm::PatchOrder order_from(const Viewpoint& view) {
  hrm::PatchOrder order;
  order.centre = view.target;
  order.apex =
      geo::geodesic_direct(view.target, geo::Bearing::degrees(view.from_deg), geo::Length::metres(view.distance_m));
  order.altitude = geo::AltitudeMsl::metres(kGround_m + view.above_m);
  order.ground_speed = geo::Speed::knots(480.0);
  order.ground_track = geo::geodesic_inverse(order.apex, order.centre).azimuth_at_start - geo::Angle::degrees(90.0);
  order.window = geo::Length::metres(view.window_m);
  order.looks = 1;
  order.map = 7;
  return order;
}

inline model::terrain::TerrainViewPointer ground_of(model::terrain::AnalyticTerrain::Height height) {
  return std::make_shared<model::terrain::AnalyticTerrain>(std::move(height));
}

// Executor that starts its threads for each job.
inline parallel::Executor executor_of(std::size_t threads) {
  return {threads, [threads](const std::function<void(std::size_t)>& job) {
            std::vector<std::thread> others;
            for (std::size_t thread = 1; thread < threads; ++thread) others.emplace_back(job, thread);
            job(0);
            for (std::thread& other : others) other.join();
          }};
}

inline hrm::PatchFormation make_patch(const radar::RadarConfiguration& configuration, const hrm::PatchOrder& order,
                                      const model::terrain::TerrainViewPointer& ground,
                                      const model::scene::SceneViewPointer& scene = nullptr, std::size_t threads = 1,
                                      std::size_t sector_points = hrm::kMaxSectorPoints,
                                      hrm::LabelUse labels = hrm::LabelUse::none) {
  hrm::PatchFormation process(configuration, executor_of(threads), sector_points, labels);
  process.begin(order);
  process.set_environment({ground, ground, scene});
  while (process.state() != hrm::PatchState::done) process.advance();
  return process;
}

inline double gamma_of(const radar::RadarConfiguration& configuration, std::size_t material) {
  return model::physics::make_land_return(configuration).gamma[material];
}

// Radar cross section [m^2] of everything on the map: the sum over its pixels.
inline double cross_section_m2(const hrm::PatchFormation& process) {
  double sum = 0.0;
  for (const float power : process.image().power) sum += static_cast<double>(power);
  return sum * hrm::unit_return_m2(process.geometry(), process.image().size);
}

}  // namespace yars::test
