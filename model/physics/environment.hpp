// Environment of a sweep (terrain, scenes, moving targets), and the echoes of the moving targets.
// Inputs: sweep geometry, receiver, terrain below the movers, sim time.
// Outputs: distance over ground [m], azimuth, power (full scale = 1) of each mover in the beam.
// Where the terrain is void, a mover stands at mean sea level.
// Threads: one thread at a time may use a Movers object.
// Source: docs/spec/physics.md#power (radar equation of a point).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sea_mirror.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/physics/target_echo.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics {

// Ship or vehicle as a point that moves along a geodesic at constant speed. A mover starts at its radar::Mover::since,
// a ship or vehicle of the external traffic at the time of its traffic record.
struct MovingPoint {
  geo::GeodesicRay way;
  double speed_mps = 0.0;
  PointTarget target{};
  double height_m = 0.0;    // above the ground
  geo::Duration since{};    // sim time at the start of `way`
  geo::Vector3 start_ecef;  // [m] start of `way`, on the ellipsoid

  geo::GeoPoint position(geo::Duration sim_time) const {
    return way.position(geo::Length::metres(speed_mps * (sim_time - since).seconds()));
  }
};

// Course at the start of a moving point.
struct Course {
  geo::GeoPoint start;
  geo::Bearing heading;
  double speed_mps = 0.0;
  geo::Duration since{};  // sim time at the start
};
MovingPoint moving_point(const Course& course, const PointTarget& target, double height_m);

// Movers of a world. The number of a mover's target is its index.
std::vector<MovingPoint> moving_points(const radar::WorldConfiguration& world);

// Terrain, polygonal scenes and external traffic of one sweep or map. Keeps references to its arguments.
struct Environment {
  // Not explicit: terrain alone converts to an environment.
  Environment(const terrain::TerrainView& terrain_view, const scene::SceneView* scene_view = nullptr,
              bool all_scenes_read = true, std::span<const MovingPoint> traffic_points = {})
      : terrain(terrain_view), scenes(scene_view), scenes_ready(all_scenes_read), traffic(traffic_points) {}

  const terrain::TerrainView& terrain;
  const scene::SceneView* scenes;  // null: none
  bool scenes_ready;               // false: some needed scene is still being read
  std::span<const MovingPoint> traffic;
  std::uint32_t scan = 1;  // number of the scan, for which echoes of movers are drawn
};

// Unobstructed return of one mover.
struct Echo {
  // Of the configured movers first, then of the traffic. It is less than the number of configured movers + kMaxTraffic,
  // and equal for a mover from sweep to sweep.
  std::size_t number = 0;
  geo::GeoPoint position;
  double above_ground_m = 0.0;
  double distance_m = 0.0;  // over ground
  double slant_range_m = 0.0;
  double offset_rad = 0.0;  // azimuth from the middle of the beam, clockwise positive
  double power = 0.0;       // full scale = 1; includes antenna gain, gas attenuation and sensitivity time control
};

inline constexpr std::size_t kMaxTraffic = 64;  // traffic targets per sweep; further targets are ignored

// Echoes of the configured movers and of up to kMaxTraffic traffic targets in one sweep. Movers stand on the terrain
// at their current position. The caller applies shadow and rain attenuation.
class Movers {
 public:
  explicit Movers(const RadarParameters& parameters);
  // Replaces the configured movers.
  void use_movers(const RadarParameters& parameters);
  void use_sea(const RadarParameters& parameters) { sea_mirror_ = SeaMirror(parameters); }
  const SeaMirror& sea_mirror() const { return sea_mirror_; }

  // Echoes of the movers within the range and within the azimuth interval point_interval(). The span is valid until the
  // next call. Does not allocate. Distances are within 3 m of the geodesic, azimuths within 1e-5 rad; with the
  // algorithm `reference` they are those of the geodesic.
  std::span<const Echo> echoes(const SweepGeometry& geometry, const Receiver& receiver, const EffectiveEarth& earth,
                               const Environment& environment);

 private:
  // Area of the sweep in which a mover has an echo.
  class Sector;
  // A position of a mover, and the sim time of it.
  struct Fix {
    geo::Vector3 ecef;  // [m] on the ellipsoid
    geo::Duration time{};
  };
  // Values that all echoes of one sweep share.
  struct Sweep {
    const SweepGeometry& geometry;
    const Receiver& receiver;
    const EffectiveEarth& earth;
    const terrain::TerrainView& terrain;
    std::uint32_t scan;
  };
  void add_echo(std::size_t number, const MovingPoint& point, const Sector& sector, const Sweep& sweep);

  bool exact_;  // azimuth and distance of the geodesic
  radar::BeamPattern beam_;
  GasPath gas_;
  TargetEchoes target_echoes_;
  SeaMirror sea_mirror_;
  std::vector<MovingPoint> points_;
  std::vector<Fix> fixes_;  // of points_, renewed after kMaxRun_m; they only limit the search
  std::vector<Echo> echoes_;
};

// Index of the sample with the centre nearest to a distance over ground. `distance_m` has the centres as from
// sample_distances(): ascending values.
std::size_t nearest_sample(std::span<const double> distance_m, double target_m);

// Number of samples with a centre nearer than `target_m`.
std::size_t samples_nearer(std::span<const double> distance_m, double target_m);

// The same, faster if the number of nearer samples is about `guess`.
std::size_t nearest_sample(std::span<const double> distance_m, double target_m, std::size_t guess);
std::size_t samples_nearer(std::span<const double> distance_m, double target_m, std::size_t guess);

}  // namespace yars::model::physics
