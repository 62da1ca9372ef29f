// Generated landscape: heights and land cover of an imaginary earth, as rows of posts and as whole cells.
// Input: a seed, optionally a box that becomes an island; a cell and its numbers of posts.
// Output: posts [m MSL], sea at 0 m and land at least 1 m, and one surface material code per post.
// Accuracy: equal bits for any number of threads and any order of cells. Neighbouring cells have equal edges. The
//   height of a position does not depend on the post spacing. Not for navigation.
// Threads: any. Source: docs/generated_terrain.md.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "worldgen/terrain/landscape_tiles.hpp"
#include "worldgen/terrain/relief.hpp"
#include "yars/requests.hpp"

namespace yars::worldgen {

using model::terrain::Material;

// Mean lower limit of permanent snow [m MSL]. It falls toward the poles. The tree line is about 900 m below this limit.
double snow_line_m(double latitude_deg);

// A position, and the properties of its ground that determine the land cover.
struct CoverSite {
  geo::GeoPoint position;
  geo::Vector3 upward;     // unit vector from the earth's centre to the position
  double height_m = 0.0;   // [m MSL] 0 or less: sea
  double steepness = 0.0;  // [m/m] magnitude of the slope
  double valley = 1.0;     // -1: river water; 0: valley floor; 0 to 1: slope of a valley; 1: outside of valleys
};

// Material of a site without regard to towns and airfields.
Material natural_cover(const CoverSite& site, std::uint32_t seed);

// Material at a distance of `radii` times the town's radius from the town's centre. The result is `natural` beyond the
// town's irregular edge, in some blocks just inside it, on water, and on ground too steep for buildings.
Material town_cover(const CoverSite& site, double radii, Material natural, std::uint32_t seed);

// Material of runway, taxiways, apron, hangars and the ground around them; `natural` outside the airfield. Not `paved`:
// soil in place of them all.
Material airfield_cover(const Airfield& airfield, geo::GeoPoint position, Material natural, bool paved = true);

// Rows of posts of one cell, computed in steps: spline over the relief, gullies, rivers, level ground of airfields,
// land cover. Immutable after construction. Any thread may make any row.
class LandscapeRows {
 public:
  LandscapeRows(LandscapeTiles& tiles, std::uint32_t seed, CellCorner corner, int rows, int columns);

  // Airfields become soil without pavement and hangars, for scenes that have these.
  void leave_airfields_unpaved() { airfields_are_paved_ = false; }

  // Heights [m MSL] and material codes of a row of posts, from west to east. Row 0 is the cell's south edge. Each span
  // must have as many elements as the row has posts.
  void make(int row, std::span<std::int16_t> posts_m, std::span<std::uint8_t> codes) const;

 private:
  struct Row;  // work data of one row
  void add_ground(Row& row, const LandscapeLattice::Row& lattice) const;
  void carve_rivers(Row& row) const;
  void level_airfields(Row& row) const;
  Material cover(const Row& row, std::size_t column) const;

  std::uint32_t seed_;
  int rows_;
  int columns_;
  CellCorner corner_;
  std::vector<std::shared_ptr<const TileFeatures>> features_;  // features of the cell and its neighbours
  std::unique_ptr<LandscapeLattice> lattice_;
  std::vector<double> longitudes_deg_;
  std::vector<double> cosines_, sines_;                // cosines and sines of the longitudes
  std::vector<std::vector<const RiverPiece*>> bands_;  // by lattice row: pieces that may change posts just north of it
  std::vector<const Town*> towns_;                     // towns of the cell and its neighbours
  std::vector<const Airfield*> airfields_;
  bool airfields_are_paved_ = true;
};

// Region that scripts/start generates. config/coast.guf, config/coast.scenes and config/routes/default.route name
// positions in it.
struct DefaultLandscape {
  static constexpr TerrainGeneration kRequest{};
  static constexpr int kSouth_deg = kRequest.south, kWest_deg = kRequest.west;
  static constexpr int kCellsNorth = kRequest.cells_lat, kCellsEast = kRequest.cells_lon;
  static constexpr std::uint64_t kSeed = kRequest.seed;
};

struct MadeCell {
  model::terrain::Cell cell;
  model::terrain::Culture culture;  // at the cell's posts
};

// A generated earth with coasts, mountain ranges, rivers, towns, airfields and woods. Height and cover are functions of
// position, seed and the island's box. Broad shapes are sampled on a lattice of 30 arc seconds (relief.hpp) and joined
// by a cubic spline. Gullies with wavelengths down to 115 m are added at each post.
class Landscape {
 public:
  // With an island's box, land ends at a coast at least 11 km inside the box's edge. Without `paved_airfields` the
  // culture of airfields is soil, for scenes that have the pavement and hangars.
  explicit Landscape(std::uint64_t seed, std::optional<LandscapeBox> island = std::nullopt,
                     bool paved_airfields = true);

  // The cell with `rows` x `columns` posts. Requires that `rows - 1` and `columns - 1` are divisors of 3600. Land is at
  // least 1 m high; sea is 0 m. River water near a mouth may be 0 m too. Requires threads >= 1; the number does not
  // change the result.
  MadeCell make(CellCorner corner, int rows, int columns, int threads = 1, const parallel::GoesOn& goes_on = {}) const;
  model::terrain::Cell cell(CellCorner corner, int rows, int columns) const { return make(corner, rows, columns).cell; }

  // Rivers, towns and airfields of one cell, and the relief of one cell.
  std::shared_ptr<const TileFeatures> features(CellCorner corner) const { return tiles_->features(corner); }
  std::shared_ptr<const ReliefTile> relief(CellCorner corner) const { return tiles_->relief(corner); }

  // False if no post of the cell can be land. True for all other cells, some of which are all sea.
  bool may_have_land(CellCorner corner) const;

 private:
  std::uint32_t seed_;
  bool paved_airfields_;
  std::unique_ptr<LandscapeTiles> tiles_;
};

}  // namespace yars::worldgen
