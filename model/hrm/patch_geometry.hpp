// Geometry of a patch map: its plane, its polar grid (range x azimuth), and the terrain that it needs.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/smooth_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

// Every value finite, the window greater than 0, the centre farther from the apex than the window's half diagonal: the
// kernel sees to it.
struct PatchOrder {
  geo::GeoPoint apex;
  geo::AltitudeMsl altitude;
  geo::Bearing ground_track;
  geo::Speed ground_speed;
  geo::GeoPoint centre;
  geo::Length window;
  int looks = 2;
  geo::Duration sim_time{};  // of the start
  std::uint32_t map = 0;     // number of the map: names its noise
  std::uint8_t band = 0;
  std::uint8_t channel = 1;
};

struct MapPoint {
  double right_m = 0.0;
  double up_m = 0.0;
};

// Where a patch map lies, and how a place becomes a point on it. The plane: distance and bearing from the aircraft are
// kept (azimuthal equidistant), turned so that the bearing of the centre points up; straight lines through the aircraft
// are its lines of sight. `right` and `up` are metres from the centre; `ahead` = up + the centre's distance.
// Heights count from the map plane, which is level at the centre's elevation and bends with the effective earth.
class PatchGeometry {
 public:
  // `elevation_m` [m] MSL of the map plane: the ground at the centre.
  PatchGeometry(const PatchOrder& order, const radar::Fidelity& fidelity, double elevation_m);

  MapPoint point_of(geo::GeoPoint place) const;
  geo::GeoPoint place_of(MapPoint point) const;

  geo::GeoPoint apex() const { return apex_; }
  geo::Bearing up() const { return up_; }
  double distance_m() const { return distance_m_; }  // over ground, apex to centre
  double window_m() const { return window_m_; }
  double plane_msl_m() const { return plane_msl_m_; }
  double altitude_m() const { return altitude_m_; }  // of the aircraft, MSL
  const physics::EffectiveEarth& earth() const { return earth_; }

  // How far the aircraft is above the map plane where it has bent away, at a distance over ground [m].
  double above_plane_m(double distance_m) const { return altitude_m_ - plane_msl_m_ + earth_.drop_m(distance_m); }
  // The same against the horizontal there: how much nearer a point comes when it is raised (layover).
  double above_level_m(double distance_m) const { return altitude_m_ - plane_msl_m_ - earth_.drop_m(distance_m); }
  // Height above the map plane [m] at which a line of sight passes a distance over ground. `tangent`: of its elevation,
  // as physics::EffectiveEarth has it for heights above mean sea level.
  double height_on_sight_m(double distance_m, double tangent) const;
  double slant_range_m() const;  // aircraft to centre
  double sin_grazing() const;    // on the map plane at the centre
  geo::Angle squint(geo::Bearing ground_track) const { return up_ - ground_track; }

 private:
  geo::GeoPoint apex_;
  double altitude_m_;
  double plane_msl_m_;
  double distance_m_;
  geo::Bearing up_;
  double window_m_;
  physics::EffectiveEarth earth_;
};

// Where a scatterer appears: distance over ground [m] of the point on the map plane that is as far from the aircraft
// (layover, foreshortening). `above_level_m`: as the geometry has it; `height_m`: the scatterer above the plane.
// d'^2 = d^2 + height (height - 2 above); 0 where nothing on the plane is as near. Height over earth radius of the
// layover is left out: 0.1 % at 9 km.
double laid_over_m(double distance_m, double height_m, double above_level_m);

// The grid on which a patch is computed: columns are lines of sight, even in the tangent of their bearing against the
// centre's; rows are even in distance over ground. Shadow and layover run along columns alone. Kept in strips of
// sixteen columns, row by row: a row of a strip is a cache line of floats, and a vector.
inline constexpr int kStripColumns = 16;

struct PolarGrid {
  int columns = 0;  // a multiple of kStripColumns
  int rows = 0;
  double first_tangent = 0.0;  // of column 0
  double tangent_step = 0.0;
  double first_distance_m = 0.0;  // of row 0, over ground
  double spacing_m = 0.0;         // between rows
  double centre_distance_m = 0.0;

  int strips() const { return columns / kStripColumns; }
  // An odd number of cache lines: a row across many strips does not meet itself in the cache.
  std::size_t strip_size() const { return static_cast<std::size_t>(rows | 1) * kStripColumns; }
  std::size_t size() const { return strip_size() * static_cast<std::size_t>(strips()); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(column / kStripColumns) * strip_size() +
           static_cast<std::size_t>(row) * kStripColumns + static_cast<std::size_t>(column % kStripColumns);
  }
  double tangent(double column) const { return first_tangent + column * tangent_step; }
  double distance_m(double row) const { return first_distance_m + row * spacing_m; }
  // Width [m] of a column at a distance: what a step of the tangent is worth as an arc.
  double width_m(double column, double distance) const {
    const double t = tangent(column);
    return distance * tangent_step / (1.0 + t * t);
  }
};

// How far beyond the window's edges something may lie that returns or shades within it [m].
struct PolarMargins {
  double near_m = 0.0;
  double far_m = 0.0;
};

// `cells` a pixel, along and across. Holds the window and the margins, as far as they lie ahead of the aircraft.
PolarGrid make_polar_grid(const PatchGeometry& geometry, int pixels, int cells, const PolarMargins& margins);

// What the fan knows of its points before profiles are cast, by PolarGrid::at(). What is read together lies together:
// who draws small triangles meets one line of the cache a point.
struct SurfacePoint {
  float gain = 0.0F;      // gamma: cross section [m^2] a square metre seen square on; negative where a thing stands
  float height_m = 0.0F;  // above the map plane, of what is highest
};

// Facing walls that stand before this point's ground: the sum of gamma times height, and how tall they are together, in
// steps of kWallStep_m. Whole numbers, so that the order in which walls are drawn is of no account.
struct WallPoint {
  std::uint32_t returned = 0;
  std::uint32_t height = 0;
};
inline constexpr float kWallStep_m = 1.0F / 4096.0F;

// What a patch map needs before it can be made: which terrain, and how far beyond its window it has to look.
// Terrain about the window, and on the way to it, which may be coarser: by the fidelity's posts a sample, for all posts
// of what is read raise the horizon (decision 19).
struct PatchNeed {
  terrain::TerrainRegion window;
  terrain::TerrainRegion path;
};
PatchNeed patch_need(const PatchOrder& order, const radar::Fidelity& fidelity);

// Where on the earth the fan reads its ground, and how finely; `tiles` stand on ground that is straight between posts.
terrain::SmoothOrder smooth_order(const PatchGeometry& geometry, const PolarGrid& grid, const radar::Fidelity& fidelity,
                                  const std::vector<const scene::Tile*>& tiles);

// For what stands or lies outside the window and is laid over or shades into it: by the relief of the ground and the
// things of the tiles.
PolarMargins fan_margins(const PatchGeometry& geometry, const terrain::TerrainView& ground,
                         const std::vector<const scene::Tile*>& tiles, const parallel::Executor& crew);

}  // namespace yars::model::hrm
