// Last steps of a patch map that is computed as power: impulse response, point targets, video.
// Inputs: MapImage in the unit of map_image.hpp; point targets of the configuration and of the surface traffic; ground
// and scene on the polar grid, which hide them.
// Outputs: the image with response and point targets; 8-bit video.
// Units: metres; power in the unit of map_image.hpp.
// Threads: one caller at a time.
// Source: docs/spec/physics.md#movers.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/radar/sensor.hpp"
#include "model/hrm/algorithm.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/point_response.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/environment.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

// Terrain and scene that can hide a point. Surface and crests are indexed by PolarGrid::at(), the horizon by column.
struct Horizons {
  const PolarGrid* grid = nullptr;
  const SurfacePoint* surface = nullptr;
  const float* crest_m = nullptr;  // as in GroundArrays::crest_m; null: none
  const float* horizon = nullptr;  // by column: greatest tangent of elevation of ground before row 0 of the grid
};

// Point targets on a map, moving or at rest (for example corner reflectors). The radial speed v_r, positive towards the
// radar, moves the apparent bearing towards the aircraft's ground track by v_r / (V sin(squint)) [rad]. V is the
// aircraft's ground speed, squint the target's bearing from the aircraft's ground track. At broadside and range R the
// shift is R v_r / V [m]. Motion during the formation time smears the image of a target.
// Source: docs/spec/physics.md#movers; Raney, "Synthetic Aperture Imaging Radar and Moving Targets" (1971).
class MapMovers {
 public:
  explicit MapMovers(const physics::RadarParameters& parameters);

  // Finds the points of world and traffic near the window, except those over ground without a known elevation.
  // Call it before the first sector. `environment` must exist until draw() has returned.
  void begin(const PatchOrder& order, const PatchGeometry& geometry, const PolarGrid& grid,
             const PatchEnvironment& environment);
  // Tests the points in the columns that the sector draws.
  void find_hidden(const PatchGeometry& geometry, const Horizons& horizons);
  // Adds the points to the image, except hidden ones.
  void draw(const PatchOrder& order, const PatchGeometry& geometry, geo::Duration formation, const Response& response,
            MapImage& image) const;

 private:
  struct Trace {
    MapPoint from, to;  // ends of the smeared image of a target on the map
  };
  // A point near the window, at the start of the formation.
  struct Target {
    const physics::MovingPoint* mover;
    double right_m, ahead_m;  // position on the map plane, from the aircraft
    double ground_m;          // [m MSL]
    double height_m;          // above the map plane
    int column = -1;          // on the polar grid; -1: outside it, not hidden
    int row = 0;
    bool hidden = false;
    double distance_m() const { return std::hypot(right_m, ahead_m); }  // over ground, from the aircraft
  };
  static std::optional<Target> find_target(const physics::MovingPoint& mover, geo::Duration sim_time,
                                           const PatchGeometry& geometry, const terrain::TerrainView& terrain);
  static void place_on_grid(const PolarGrid& grid, Target& target);
  void draw_point(const Target& target, const PatchOrder& order, const PatchGeometry& geometry, geo::Duration formation,
                  const Response& response, MapImage& image) const;
  Trace trace_of(const physics::MovingPoint& mover, const PatchOrder& order, const PatchGeometry& geometry,
                 geo::Duration formation, double height_m) const;
  bool hidden(const PatchGeometry& geometry, const Horizons& horizons, const Target& target) const;

  physics::GasPath gas_;
  physics::TargetEchoes target_echoes_;
  std::vector<physics::MovingPoint> points_;
  std::vector<Target> targets_;  // of the current map
};

// For algorithms that compute power: the last part of the stage `map`, and the stage `video`. The video always has
// thermal noise. It has speckle only if the fidelity's `noise` is on.
class PowerPicture {
 public:
  explicit PowerPicture(const physics::RadarParameters& parameters);

  // Finds the point targets that ground or scene hide. Call it for each sector before add_response_and_movers().
  void find_hidden_points(const PatchInputs& inputs, const PatchData& data);
  // Applies the response if the fidelity's `map_response` is on. Adds point targets, moving or at rest.
  void add_response_and_movers(const PatchInputs& inputs, PatchData& data);
  void draw_video(const PatchInputs& inputs, PatchData& data) const;

 private:
  double thermal_noise(const PatchInputs& inputs, const PatchData& data) const;

  radar::HighResolutionConfiguration high_resolution_;
  std::uint64_t seed_;
  bool with_speckle_, with_response_;
  MapMovers movers_;
  Response response_;
};

}  // namespace yars::model::hrm
