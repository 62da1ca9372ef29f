// Geometry of one patch map: map plane, polar grid and the terrain that the map needs.
// Polar grid: rows are ground range, columns are azimuth.
// Units: metres, radians; heights above mean sea level or above the map plane, as named.
// Frame: azimuthal equidistant projection about the aircraft, which keeps distance and bearing from the aircraft. It is
// turned so that the bearing of the map's centre points up on the map.
// Accuracy: position_of() inverts point_of() within 1 mm, at the poles and across the antimeridian too.
// Source: docs/radar_maths.md, "Patch maps"; docs/spec/physics.md#layover.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/smooth_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::radar {
struct Fidelity;
}  // namespace yars::radar

namespace yars::model::hrm {

// Command of one patch map. The caller ensures that every value is finite, `window` is greater than 0, and the centre
// is farther from the apex than half the window's diagonal.
struct PatchOrder {
  geo::GeoPoint apex;  // position of the aircraft
  geo::AltitudeMsl altitude;
  geo::Bearing ground_track;
  geo::Speed ground_speed;
  geo::GeoPoint centre;
  geo::Length window;        // side of the square that the map covers
  int looks = 2;             // number of averaged looks
  geo::Duration sim_time{};  // start of the formation
  std::uint32_t map = 0;     // number of the map; selects the noise, together with the seed
  std::uint8_t band = 0;
  std::uint8_t channel = 1;
};

// Position on the map plane relative to the map's centre: to the right of the line of sight from aircraft to centre,
// and along that line (up: away from the aircraft).
struct MapPoint {
  double right_m = 0.0;
  double up_m = 0.0;
};

// Position and orientation of a patch map. The map plane is azimuthal equidistant about the aircraft, so lines of sight
// are straight lines on the plane. In code, `ahead_m` is up_m + distance_m(): the coordinate from the aircraft towards
// the centre. The map plane has the centre's elevation and curves with the effective earth. Heights are above the map
// plane if neither name nor comment says otherwise.
class PatchGeometry {
 public:
  // `elevation_m` [m MSL]: ground at the centre, which becomes the height of the map plane.
  PatchGeometry(const PatchOrder& order, const physics::GeometryParameters& parameters, double elevation_m);

  MapPoint point_of(geo::GeoPoint position) const;
  geo::GeoPoint position_of(MapPoint point) const;

  geo::GeoPoint apex() const { return apex_; }
  geo::Bearing up() const { return up_; }            // from aircraft to centre
  double distance_m() const { return distance_m_; }  // over ground, from aircraft to centre
  double window_m() const { return window_m_; }
  double plane_msl_m() const { return plane_msl_m_; }  // elevation of the map plane
  double altitude_m() const { return altitude_m_; }    // of the aircraft, above mean sea level
  const physics::EffectiveEarth& earth() const { return earth_; }
  // The same for altitudes and heights above the map plane.
  const physics::EffectiveEarth& earth_above_plane() const { return earth_above_plane_; }

  // The point at a distance over ground and at a height above the map plane has the tangent of elevation
  // (height - above_plane_m()) / sight_distance_m(). The earth's curvature lowers the plane, refraction lifts it.
  // above_plane_m(): height [m] of the aircraft above the plane's point, along the vertical at the aircraft.
  // sight_distance_m(): the distance, up to 1 % longer where refraction lifts low points more than high ones.
  double above_plane_m(double distance_m) const { return plane_sight(distance_m).above_m; }
  double sight_distance_m(double distance_m) const { return plane_sight(distance_m).distance_m; }
  // Height [m] of the aircraft above the local horizontal plane at the map plane's point at a distance over ground. If
  // the point is raised, its slant range decreases in proportion to this height (layover). Slant ranges are straight.
  double above_level_m(double distance_m) const { return altitude_m_ - plane_msl_m_ - earth_.drop_m(distance_m); }
  // Height [m] above the map plane of a line of sight at a distance over ground. `tangent`: tangent of the line's
  // elevation angle against the horizontal at the aircraft, positive up.
  double height_on_sight_m(double distance_m, double tangent) const;
  // The point at a distance over ground and at the height h above mean sea level has the tangent of elevation
  // (h * cosine - above + bow p^2) / (chord + h * sine), p its height above the map plane. The terms beside the
  // geometry are the lift by refraction. height_at() inverts it.
  struct SightLine {
    double above_m, chord_m, sine, cosine, bow;
    // [m] above the plane at `plane_msl_m`. The term in p is far less than p.
    double height_at(double tangent, double plane_msl_m) const {
      const double per_metre = 1.0 / (cosine - tangent * sine);
      const double height_m = (above_m + tangent * chord_m) * per_metre - plane_msl_m;
      return height_m - bow * height_m * height_m * per_metre;
    }
  };
  SightLine sight_line(double distance_m) const;
  struct PlaneSight {
    double above_m, distance_m;
  };
  PlaneSight plane_sight(double distance_m) const;
  double slant_range_m() const;  // from aircraft to centre
  double sin_grazing() const;    // sine of the grazing angle at the centre
  geo::Angle squint(geo::Bearing ground_track) const { return up_ - ground_track; }  // positive: right of the track

 private:
  geo::GeoPoint apex_;
  double altitude_m_;
  double plane_msl_m_;
  double distance_m_;
  geo::Bearing up_;
  double window_m_;
  physics::EffectiveEarth earth_, earth_above_plane_;
  terrain::SightSeries series_;
};

// Distance over ground [m] of the point on the map plane at the slant range of a scatterer (layover, foreshortening).
// `distance_m`: distance over ground of the scatterer; `height_m`: height of the scatterer above the plane;
// `above_level_m`: PatchGeometry::above_level_m(distance_m).
// Formula: d'^2 = d^2 + height * (height - 2 * above_level). 0 if no point of the plane is that near. The formula
// neglects the ratio of height to earth radius, which is 0.1 % for a height of 9 km.
double laid_over_m(double distance_m, double height_m, double above_level_m);

// Columns of one strip. The grid is stored strip by strip, and row by row within a strip. One row of a strip of
// floats fills a cache line and a 512-bit vector. Do not change the number, because loops and indices rely on 16.
inline constexpr int kStripColumns = 16;

// Grid on which a patch map is computed. Columns are evenly spaced in the tangent of their bearing relative to that of
// the map's centre. Rows are evenly spaced in distance over ground, row 0 nearest to the aircraft. Shadow and layover
// act within one column.
// Sector: the strips [first_strip, end_strip), which the arrays of the map hold. A large map is computed sector by
// sector; else the sector is the whole grid. Neighbouring sectors overlap by two strips, for the interpolation.
struct PolarGrid {
  int columns = 0;  // a multiple of kStripColumns
  int rows = 0;
  double first_tangent = 0.0;     // tangent of column 0
  double tangent_step = 0.0;      // difference of tangent between columns
  double first_distance_m = 0.0;  // distance of row 0, over ground from the aircraft
  double spacing_m = 0.0;         // between rows
  double centre_distance_m = 0.0;
  int first_strip = 0;
  int end_strip = 0;

  int strips() const { return columns / kStripColumns; }
  // Columns [first_drawn_column(), end_drawn_column()): those whose pixels the sector draws. The strip at the border to
  // another sector is not drawn.
  int first_drawn_column() const { return first_strip == 0 ? 0 : (first_strip + 1) * kStripColumns; }
  int end_drawn_column() const { return end_strip == strips() ? columns : (end_strip - 1) * kStripColumns; }
  // The number of rows is made odd, so that rows of equal number in neighbouring strips lie in different cache sets.
  std::size_t strip_size() const { return static_cast<std::size_t>(rows | 1) * kStripColumns; }
  // Number of entries of an array, and the entry of a point of the sector.
  std::size_t size() const { return strip_size() * static_cast<std::size_t>(end_strip - first_strip); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(column / kStripColumns - first_strip) * strip_size() +
           static_cast<std::size_t>(row) * kStripColumns + static_cast<std::size_t>(column % kStripColumns);
  }
  double tangent(double column) const { return first_tangent + column * tangent_step; }
  double distance_m(double row) const { return first_distance_m + row * spacing_m; }
  // Width [m] of a column at a distance [m]: the arc of one tangent step.
  double width_m(double column, double distance) const {
    const double t = tangent(column);
    return distance * tangent_step / (1.0 + t * t);
  }
};

// Extensions of the grid past the window's edges [m], for ground and objects that are laid over into the window or cast
// shadow into it.
struct PolarMargins {
  double near_m = 0.0;  // from the near edge towards the aircraft
  double far_m = 0.0;   // beyond the far edge
};

// Returns the polar grid of a map with `pixels` pixels per side and `cells` grid cells per side of a pixel. The grid
// covers the window in azimuth. In range it covers window and margins, at most up to the aircraft. A margin is limited
// to 4 windows. The sector is the whole grid.
PolarGrid make_polar_grid(const PatchGeometry& geometry, int pixels, int cells, const PolarMargins& margins);

// Returns the first strip of each of the fewest sectors whose arrays have at most `points` entries, followed by the
// number of strips. A sector has at least one strip beside its overlap, even if its arrays then have more entries.
std::vector<int> sectors_of(const PolarGrid& grid, std::size_t points);

// Surface at one grid point, the input of the stage `profile`. Arrays are indexed by PolarGrid::at(). Gamma and height
// share a cache line because the scene raster updates both.
struct SurfacePoint {
  // Cross section per projected area [m^2/m^2]. Negated for a standing scene surface: one that is not on the ground.
  float gamma = 0.0F;
  float height_m = 0.0F;  // highest surface, above the map plane
};

// Sums over the walls that face the radar between the previous row's grid point and this one, in steps of kWallStep_m.
// Integer sums do not depend on the drawing order.
struct WallPoint {
  std::uint32_t returned_steps = 0;  // sum of gamma times height
  std::uint32_t height_steps = 0;    // sum of heights
  std::uint32_t facing_steps = 0;    // as returned_steps, but of the cardinal effect alone
};
inline constexpr float kWallStep_m = 1.0F / 4096.0F;  // [m] 0.24 mm; sums are limited to 2^31 steps, 524 km

// Terrain regions of a patch map. `path` is the region from the aircraft to the window and may be coarser. The
// fidelity's `posts_per_sample` selects the detail. Every post of the loaded terrain can raise the horizon
// (decision 19).
struct PatchNeed {
  terrain::TerrainRegion window;
  terrain::TerrainRegion path;
};
PatchNeed patch_need(const PatchOrder& order, const radar::Fidelity& fidelity);

// Area on the earth and node spacing of the smoothed ground below the polar grid. Below `tiles` the ground remains
// bilinear between posts.
terrain::SmoothParameters smoothing_parameters(const PatchGeometry& geometry, const PolarGrid& grid,
                                               const radar::Fidelity& fidelity,
                                               const std::vector<const scene::Tile*>& tiles);

// Returns the margins for ground and objects that are laid over or cast shadow into the window. The margins follow from
// the relief of the ground and the heights of the tiles.
PolarMargins polar_margins(const PatchGeometry& geometry, const terrain::TerrainView& ground,
                           const std::vector<const scene::Tile*>& tiles, const parallel::Executor& executor);

}  // namespace yars::model::hrm
