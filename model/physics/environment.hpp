// Environment of a sweep: terrain, scenes, moving targets, and the echoes of these targets.
#pragma once

#include <span>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics {

// A ship or a vehicle as a point that goes its geodesic at a steady speed: one of the configuration from sim time 0 on,
// one of the traffic from the moment at which it was heard of.
struct MovingPoint {
  geo::GeodesicRay way;
  double speed_mps = 0.0;
  double cross_section_m2 = 0.0;
  double height_m = 0.0;  // above the ground
  geo::Duration since{};  // sim time at which it was at the begin of its way

  geo::GeoPoint place(geo::Duration sim_time) const {
    return way.position(geo::Length::metres(speed_mps * (sim_time - since).seconds()));
  }
};

std::vector<MovingPoint> configured_points(const radar::RadarConfiguration& configuration);

// What a sweep looks into: terrain and, where there are any, polygonal scenes and traffic from outside. References: for
// the call alone.
struct Environment {
  // Terrain alone is a database, too.
  Environment(const terrain::TerrainView& given, const scene::SceneView* scenes_given = nullptr, bool whole = true,
              std::span<const MovingPoint> traffic_given = {})
      : terrain(given), scenes(scenes_given), scenes_ready(whole), traffic(traffic_given) {}

  const terrain::TerrainView& terrain;
  const scene::SceneView* scenes;  // null: none
  bool scenes_ready;               // false: some of what is wanted is still being read
  std::span<const MovingPoint> traffic;
};

// What comes back from one mover, if nothing hides it.
struct Echo {
  double distance_m = 0.0;  // over ground
  double tangent = 0.0;     // of its elevation angle
  double power = 0.0;       // full scale = 1, after sensitivity time control; gains and what gases take in it
};

inline constexpr std::size_t kMaxTraffic = 64;

// Ships and vehicles as a sweep sees them: points that go their geodesics with sim time, on the ground where they are.
// Shadow is the caller's: it knows the horizon. Source: docs/spec/physics.md#power, the radar equation of a point.
// Those of the configuration and those of the traffic, of which no more than kMaxTraffic are looked at.
class Movers {
 public:
  explicit Movers(const radar::RadarConfiguration& configuration);

  // Those within the range and two beam widths of the beam. Valid until the next call; allocates nothing.
  std::span<const Echo> echoes(const SweepGeometry& look, const Receiver& receiver, const EffectiveEarth& earth,
                               const Environment& database);

 private:
  void add_echoes(std::span<const MovingPoint> points, const SweepGeometry& look, const Receiver& receiver,
                  const EffectiveEarth& earth, const terrain::TerrainView& terrain);

  radar::BeamPattern beam_;
  GasPath gas_;
  std::vector<MovingPoint> points_;
  std::vector<Echo> echoes_;
};

// The sample that holds a distance over ground: the one whose centre is nearest. Centres ascend, NaN first; no samples
// or only NaN: the number of samples.
std::size_t nearest_sample(std::span<const double> distance_m, double wanted_m);

// How many samples are nearer than a distance over ground: their centres are less, or not a number.
std::size_t samples_nearer(std::span<const double> distance_m, double wanted_m);

}  // namespace yars::model::physics
