// Interfaces of terrain: TerrainView, which kernels sample, and TerrainStore, which makes views; regions of terrain.
// Input: WGS84 positions in degrees. Output: elevation [m MSL], water fraction [0, 1], DFAD material code.
// A reduced cell keeps every 2^n-th post. Each kept post has two heights: the mean of the original posts around it, and
//   the peak, the highest ground around it (cell.hpp). DFAD codes: culture.hpp.
// Accuracy: surface_at() is double precision; surfaces() differs by at most 0.05 m + 1e-6 of the cell's relief.
// Errors: voids, and positions that are not finite, have elevation NaN. A store reports problems as sentences.
// Threads: any thread may read a view, which is immutable. prepare() runs on one thread at a time and may wait.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/modes.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::terrain {

// Box between two parallels and two meridians. West is less than east; east may exceed 180.
struct GeoBox {
  double south_deg = 0.0, north_deg = 0.0;
  double west_deg = 0.0, east_deg = 0.0;
};

// The ground at one position.
struct Surface {
  double elevation_m = 0.0;     // [m] MSL; NaN = void
  double water = 0.0;           // [0, 1] water fraction: weight of the posts at exactly 0 m
  std::uint8_t material = 0;    // surface material code of the nearest post; 0 = land, or sea according to `water`
  bool loaded = true;           // false: the cell has a file that is not in memory yet
  double peak_m = elevation_m;  // [m] MSL highest ground around the position if the cell is reduced, else elevation_m
};

// Successive positions for the fast path: surfaces() and crests(). Each position has a cell, counted from `corner`, and
// an offset in the cell. Single precision resolves the offset to 0.004 m. Cell counts east may exceed +-360.
struct PositionRun {
  CellCorner corner;                               // the cell with counts 0, 0
  std::span<const float> cells_north, cells_east;  // whole numbers of cells from `corner`
  std::span<const float> north_deg, east_deg;      // [0, 1] from the cell's south-west corner
};

inline geo::GeoPoint position_of(const PositionRun& positions, std::size_t i) {
  return {positions.corner.south_deg + static_cast<double>(positions.cells_north[i]) +
              static_cast<double>(positions.north_deg[i]),
          positions.corner.west_deg + static_cast<double>(positions.cells_east[i]) +
              static_cast<double>(positions.east_deg[i])};
}

// Ground shortly before each position of a ray, seen from its start. It limits the error of a horizon where bilinear
// ground bulges between the rows and columns of posts. NaN where a row or column lies between that ground and the
// position: crests() finds the ground on it. Views that do not compute it write nothing. Requires even spacing.
struct NearGround {
  float step_m = 0.0F;          // [m] distance between successive positions
  std::span<float> height_m{};  // [m MSL] as peak_m; empty: not computed
  std::span<float> back_m{};    // [m] distance before the position: a tenth of the posts' spacing, below step_m
};

// Outputs of the fast path, each as long as the positions. An empty `peak_m` or `material` is not computed.
struct SurfaceRun {
  std::span<float> elevation_m;      // [m] MSL; NaN = void
  std::span<float> water;            // [0, 1]
  std::span<float> peak_m;           // [m] MSL highest ground around it if the cell is reduced, else elevation_m
  std::span<std::int32_t> material;  // codes as in Surface::material, 0 to kMaxMaterial
  NearGround near{};
};

// Spare entries after the last one in arrays of the fast path. SIMD code may read and overwrite them.
inline constexpr std::size_t kRunSlack = 16;

// Spacing of the posts of a cell.
struct PostSpacing {
  double ray_step_m = 0.0;   // [m] step along a ray: smaller of row and column spacing, but >= 1/3 of row spacing
  double rows_deg = 0.0;     // [deg] latitude between rows; a row lies on every whole degree
  double columns_deg = 0.0;  // [deg] longitude between columns; a column lies on every whole degree
};

// Lift of a point by refraction, from one observer: its tangent of elevation is (up + lift) / out. Out and up are those
// of the straight line to it. The lift is s (level + per_height h + min(s, max_square) (per_square + per_both h)), s
// the squared slant range and h the height [m]. Zeros: rays are straight over the effective earth.
struct RayLift {
  double level = 0.0, per_height = 0.0, per_square = 0.0, per_both = 0.0;
  double max_square_m2 = 0.0;

  double at_m(double square_m2, double height_m) const {
    return square_m2 *
           (level + per_height * height_m + std::min(square_m2, max_square_m2) * (per_square + per_both * height_m));
  }
};

// The height `up` of the fast path, with the lift: h tilt(a a) - d a fall(a a) - altitude_m. h and d are height and
// distance of the point, a = d / radius. fall(x) = fall + fall_square x, tilt(x) = upright - x (tilt + tilt_square x).
// The defaults are the series of 1 - cos a and cos a. The lift is within 0.4 m of RayLift::at_m() for points up to 4 km
// high: it is linear in height.
struct SightSeries {
  float fall = 0.5F, fall_square = -1.0F / 24.0F;
  float upright = 1.0F, tilt = 0.5F, tilt_square = -1.0F / 24.0F;
  float altitude_m = 0.0F;

  // Coefficients at one distance: the tangent of elevation is (h cosine - above) / (chord + h sine). `curvature`: of
  // the sphere.
  struct Line {
    double above_m, chord_m, sine, cosine;
    double tangent(double height_m) const { return (height_m * cosine - above_m) / (chord_m + height_m * sine); }
  };
  Line at(double curvature, double distance_m) const;
};
struct RaySight;
SightSeries sight_series(const RaySight& sight);

// Geometry of a ray from an observer at its start, over a sphere: the earth with the lift of refraction, or an
// effective earth, whose radius accounts for refraction.
struct RaySight {
  double altitude_m = 0.0;  // [m] MSL of the observer
  double curvature = 0.0;   // [1/m] of the sphere
  RayLift lift{};
  std::span<const float> distance_m{};  // [m] ground distance of the positions, ascending
  // For each position, the highest tangent of all positions up to it, itself included. Crests below it hide nothing,
  // and crests() may leave them out, as well as the ground shortly before evenly spaced positions (NearGround).
  // Empty: all crests are found.
  std::span<const float> horizon{};
};
inline constexpr float kNoTangent = -1.0e30F;  // tangent of an elevation angle below any ground

// Immutable terrain in memory. A store makes it on the loader's thread; kernels sample it on any number of threads.
// A change of terrain is a new view with a higher generation.
class TerrainView {
 public:
  using Interpolation = radar::Interpolation;

  TerrainView() = default;
  TerrainView(const TerrainView&) = delete;
  TerrainView& operator=(const TerrainView&) = delete;
  virtual ~TerrainView() = default;

  // Number of the view, ascending within a store. Recorded ticks contain this number.
  virtual std::uint64_t generation() const = 0;
  virtual std::uint64_t resident_bytes() const = 0;

  // The ground at one position, in double precision. Longitude is wrapped, latitude clamped to the poles. Void posts
  // are left out, and the weights of the others are scaled to a sum of 1. If all posts are void, elevation is NaN.
  virtual Surface surface_at(geo::GeoPoint position, Interpolation interpolation = Interpolation::bilinear) const = 0;
  double elevation_m(geo::GeoPoint position) const { return surface_at(position).elevation_m; }

  // True if all cells within the scan's range are in the versions for this detail (TerrainRegion::detail). False while
  // coarser or finer versions replace some of them.
  virtual bool has_detail(int /*detail*/) const { return true; }
  // True if peak_m may differ from elevation_m at some position.
  virtual bool has_peaks() const { return false; }
  // [m] minimum spacing of posts in the view; 0 if there are no posts or the view does not report the spacing.
  virtual double post_spacing_m() const { return 0.0; }
  // Spacing of the posts at a position; zeros if there are no posts or the view does not report the spacing.
  virtual PostSpacing post_spacing_at(geo::GeoPoint /*position*/) const { return {}; }
  // The cells that overlap a box; empty if the ground has no posts.
  virtual std::vector<std::shared_ptr<const Cell>> cells_within(const GeoBox& /*box*/) const { return {}; }
  // True if the material may differ from 0 at some position.
  virtual bool has_materials() const { return false; }

  // The ground at a run of positions, in single precision: the fast path. Error against surface_at() at the same
  // position: at most 0.05 m + 1e-6 of the cell's relief. Returns the number of positions in cells that are not loaded
  // yet; their elevation is NaN.
  virtual std::size_t surfaces(const PositionRun& positions, Interpolation interpolation,
                               const SurfaceRun& found) const = 0;

  // For each position: the maximum tangent of the ground's elevation angle, seen from the observer and positive above
  // the horizontal, between the previous position and this one. For the first position: between the ray's start and
  // this one. Candidates are the points where the ray crosses rows and columns of posts, with heights linear between
  // two posts, and one point shortly before each position. Reduced cells use their peaks. kNoTangent where there is no
  // candidate. Returns false, and writes nothing, if the ground is a formula without posts.
  virtual bool crests(const PositionRun& /*positions*/, const RaySight& /*sight*/, std::span<float> /*tangent*/) const {
    return false;
  }
};

using TerrainViewPointer = std::shared_ptr<const TerrainView>;

// Circle of terrain to load, and its detail.
struct TerrainRegion {
  geo::GeoPoint centre;
  double radius_m = 0.0;
  int detail = 0;  // posts closer than 2^detail metres are not needed; 0 = the finest available
  // [m] range of the current scan. has_detail() is true for a view even if cells beyond this range are missing.
  double reach_m = std::numeric_limits<double>::infinity();
};

// The detail at which posts `spacing_m` apart suffice. 0 below 2 m, for infinity and for NaN.
int detail_for(double spacing_m);

// Source of views. prepare() may read files and wait; one thread at a time calls it.
class TerrainStore {
 public:
  TerrainStore() = default;
  TerrainStore(const TerrainStore&) = delete;
  TerrainStore& operator=(const TerrainStore&) = delete;
  virtual ~TerrainStore() = default;

  // A view with all cells that exist within the region. Cells outside may be dropped from memory.
  // Returns the same view, with the same generation, while nothing changes.
  virtual TerrainViewPointer prepare(const TerrainRegion& region) = 0;

  // Like prepare(), but in steps, nearest cells first. After each cell but the last, `interim` receives a view of the
  // cells so far. In this view, a cell that is not loaded is replaced by its next coarser version in memory, else by
  // the next finer version. If `interim` returns false, loading ends and that view is the result.
  using Interim = std::function<bool(const TerrainViewPointer&)>;
  virtual TerrainViewPointer prepare_in_steps(const TerrainRegion& region, const Interim& /*interim*/) {
    return prepare(region);
  }

  // Problems that prepare() found since the last call, such as unreadable cells. Each problem is one sentence.
  // Call it on the thread of prepare().
  virtual std::vector<std::string> take_problems() { return {}; }
  // The same for notes: how data are taken, such as the accuracy of a change of datum. No data are left out.
  virtual std::vector<std::string> take_notes() { return {}; }
};

// The one-degree cells that the region's circle touches, with or without a file, in ascending order of slot_of(), each
// once. A few cells just outside the circle may be included. The circle may cross the antimeridian and contain a pole.
std::vector<CellCorner> cells_within(const TerrainRegion& region);

// Great-circle angle [deg] from a point to the centre of a cell. If the angle from the centre of a circle exceeds
// touched_within_deg(radius), the circle does not touch the cell.
double angle_to_centre_deg(geo::GeoPoint point, CellCorner corner);
double touched_within_deg(double radius_m);

}  // namespace yars::model::terrain
