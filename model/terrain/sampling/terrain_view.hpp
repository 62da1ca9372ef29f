// Terrain as the kernels read it: views, stores, and the cells that a region touches.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::terrain {

// A part of the earth between two parallels and two meridians. West is less than east, which may be beyond 180.
struct GeoBox {
  double south_deg = 0.0, north_deg = 0.0;
  double west_deg = 0.0, east_deg = 0.0;
};

// The ground at one place.
struct Surface {
  double elevation_m = 0.0;     // [m] MSL; NaN = void
  double water = 0.0;           // [0, 1] share of posts at exactly 0 m
  std::uint8_t material = 0;    // surface material code of the nearest post; 0 = none given: land or sea by `water`
  bool loaded = true;           // false: a file has it, but it is not in memory yet
  double peak_m = elevation_m;  // [m] MSL highest ground about the place where a coarser level stands in
};

// Places in a row for the fast path: which cell each lies in, counted from one of them, and where in it [0, 1] deg.
// Float holds that to 0.004 m. Cells may run on beyond any multiple of a turn.
struct PlaceRun {
  CellPlace corner;
  std::span<const float> cells_north, cells_east;  // whole numbers
  std::span<const float> north_deg, east_deg;
};

inline geo::GeoPoint place_of(const PlaceRun& places, std::size_t i) {
  return {
      places.corner.south_deg + static_cast<double>(places.cells_north[i]) + static_cast<double>(places.north_deg[i]),
      places.corner.west_deg + static_cast<double>(places.cells_east[i]) + static_cast<double>(places.east_deg[i])};
}

// Where the fast path puts what it finds, each as long as the places. `peak_m` and `material` may be empty: not asked.
struct SurfaceRun {
  std::span<float> elevation_m;  // [m] MSL; NaN = void
  std::span<float> water;        // [0, 1]
  std::span<float> peak_m;       // [m] highest ground about the place where a coarser level stands in, else elevation
  std::span<std::int32_t> material;  // codes up to kLargestMaterial
};

// Arrays of the fast path have this many entries more behind the last one, which may be read and overwritten.
inline constexpr std::size_t kRunSlack = 16;

// How close the posts of a cell stand.
struct PostSpacing {
  double walked_m = 0.0;     // between the closest, but columns nearer than a third of the rows count as that far apart
  double columns_deg = 0.0;  // of longitude, between columns; one lies on every whole degree
};

// How a ray sees its ground, for the fast path: from an eye at its beginning, over a sphere.
struct RaySight {
  double altitude_m = 0.0;            // MSL of the eye
  double curvature = 0.0;             // [1/m] of the effective earth
  std::span<const float> distance_m;  // over ground, of the places, ascending
};
inline constexpr float kNoTangent = -1.0e30F;  // of an elevation angle: below every ground

// Terrain as the kernel reads it: immutable, in memory, made by prepare() on a loader's thread and read by
// compute() on any number of threads. A change of terrain is a new view with a higher generation.
class TerrainView {
 public:
  using Interpolation = radar::Interpolation;

  TerrainView() = default;
  TerrainView(const TerrainView&) = delete;
  TerrainView& operator=(const TerrainView&) = delete;
  virtual ~TerrainView() = default;

  // Counts up with every view of a store; part of the tick log.
  virtual std::uint64_t generation() const = 0;
  virtual std::uint64_t resident_bytes() const = 0;

  // The ground at one place, in double. Any longitude (wrapped), latitude clamped to the poles. A void among the posts
  // is left out and the weights of the others are scaled; all void = NaN.
  virtual Surface surface_at(geo::GeoPoint place, Interpolation interpolation = Interpolation::bilinear) const = 0;
  double elevation_m(geo::GeoPoint place) const { return surface_at(place).elevation_m; }

  // True if this is what prepare() gives for a region of this detail, as far as a scan reaches; false: something else
  // still stands in.
  virtual bool serves(int /*detail*/) const { return true; }
  // True if peak_m may differ from elevation_m anywhere.
  virtual bool has_peaks() const { return false; }
  // [m] between the closest posts anywhere in it: between them the ground is what interpolation makes of it. 0: not
  // told.
  virtual double post_spacing_m() const { return 0.0; }
  // The posts about a place; all 0: none there, or not told.
  virtual PostSpacing post_spacing_at(geo::GeoPoint /*place*/) const { return {}; }
  // The cells of posts that have a part in a box; none where the ground is not made of posts.
  virtual std::vector<std::shared_ptr<const Cell>> cells_within(const GeoBox& /*box*/) const { return {}; }
  // True if a material other than 0 may be found anywhere.
  virtual bool has_materials() const { return false; }

  // The same for a run of places, in float: the fast path. Error against surface_at at most 0.05 m + 1e-6 of the
  // cell's relief, for the same position. Returns how many places met a cell that is not loaded yet (NaN there).
  virtual std::size_t surfaces(const PlaceRun& places, Interpolation interpolation, const SurfaceRun& found) const = 0;

  // The greatest tangent of all lines of posts that the ray crosses on its way to each place from the one before (to
  // the first from the ray's beginning); kNoTangent where it crosses none. Straight between two posts, of the highest
  // ground where a coarser level stands in. False and nothing written where the ground is not made of posts.
  virtual bool crests(const PlaceRun& /*places*/, const RaySight& /*sight*/, std::span<float> /*tangent*/) const {
    return false;
  }
};

using TerrainViewPointer = std::shared_ptr<const TerrainView>;

// What a scan can reach: a disc on the earth, and how fine it has to be: posts closer than 2^detail metres are not
// needed; 0 = the finest that there are.
struct TerrainRegion {
  geo::GeoPoint centre;
  double radius_m = 0.0;
  int detail = 0;
  // [m] what the scan reaches by itself: farther out cells may come later, and a view without them serves.
  double reach_m = std::numeric_limits<double>::infinity();
};

// The detail for which posts this far apart [m] do; 0 for anything below two metres and for what is no length.
int detail_for(double spacing_m);

// Where views come from. prepare() may read files and wait; it is called by one thread at a time.
class TerrainStore {
 public:
  TerrainStore() = default;
  TerrainStore(const TerrainStore&) = delete;
  TerrainStore& operator=(const TerrainStore&) = delete;
  virtual ~TerrainStore() = default;

  // A view that holds all that exists within the region; posts outside may be dropped from memory.
  // The same view (same generation) is returned while nothing has to change.
  virtual TerrainViewPointer prepare(const TerrainRegion& region) = 0;

  // The same in steps, for who need not wait for the whole: nearest cells first; after each but the last, `interim`
  // gets a view of what there is. A cell still to come is there in the next coarser version in memory, else in a finer
  // one, else it is not loaded. If `interim` returns false the rest stays out, and that view is the result.
  using Interim = std::function<bool(const TerrainViewPointer&)>;
  virtual TerrainViewPointer prepare_in_steps(const TerrainRegion& region, const Interim& /*interim*/) {
    return prepare(region);
  }

  // What prepare() has met since the last call and a person should know: unreadable cells, odd files. Each once,
  // a sentence each; same thread as prepare().
  virtual std::vector<std::string> take_problems() { return {}; }
};

// The one-degree cells that a disc on the earth touches; a few that it only nears may be among them.
// Works across the antimeridian and over the poles. Result in ascending slot order, each once.
std::vector<CellPlace> cells_within(const TerrainRegion& region);

// Great-circle angle [deg] from a point to a cell's middle. A disc touches no cell that is farther than
// touched_within_deg() of its radius.
double angle_to_middle_deg(geo::GeoPoint point, CellPlace place);
double touched_within_deg(double radius_m);

}  // namespace yars::model::terrain
