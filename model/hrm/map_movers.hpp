// Moving targets, and points that stand (a corner reflector is one), on a map: displaced along the track by what their
// radial speed adds to the Doppler, and smeared over the time that the map takes. Radial speed v_r, positive towards
// the radar, shifts the bearing by v_r / (V sin(squint)) forwards: R v_r / V across a broadside line of sight.
// Source: docs/spec/physics.md#movers; Raney, "Synthetic Aperture Imaging Radar and Moving Targets" (1971).
#pragma once

#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/fan_grid.hpp"
#include "model/hrm/fan_point.hpp"
#include "model/hrm/response.hpp"
#include "model/rbm/database.hpp"
#include "model/rbm/gas_path.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::hrm {

// What stands in the way of a point: highest tangent of all that is nearer, by column and row of the fan.
struct Horizons {
  const FanGrid* grid = nullptr;
  const SurfacePoint* surface = nullptr;
  const float* crest_m = nullptr;  // as lanes::Strip has it; null: none
  const float* horizon = nullptr;  // before row 0
};

class MapMovers {
 public:
  explicit MapMovers(const radar::RadarConfiguration& configuration);

  // Those of the configuration and of the traffic.
  void draw(const PatchOrder& order, const PatchGeometry& geometry, geo::Duration formation,
            const rbm::Database& database, const Horizons& horizons, const Response& response, MapImage& image) const;

 private:
  struct Trace {
    MapPoint from, to;  // on the map, where it appears at the start and at the end
  };
  void draw_point(const rbm::MovingPoint& mover, const PatchOrder& order, const PatchGeometry& geometry,
                  geo::Duration formation, const terrain::TerrainView& terrain, const Horizons& horizons,
                  const Response& response, MapImage& image) const;
  Trace trace_of(const rbm::MovingPoint& mover, const PatchOrder& order, const PatchGeometry& geometry,
                 geo::Duration formation, double height_m) const;
  bool hidden(const PatchGeometry& geometry, const Horizons& horizons, MapPoint point, double height_m) const;

  rbm::GasPath gas_;
  std::vector<rbm::MovingPoint> points_;
};

}  // namespace yars::model::hrm
