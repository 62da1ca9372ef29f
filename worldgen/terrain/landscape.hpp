// Made-up earth: land cover, rows of posts, and whole cells of both.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "worldgen/terrain/landscape_tiles.hpp"
#include "worldgen/terrain/relief.hpp"

namespace yars::worldgen {

using model::terrain::Material;

// What covers a post of the made-up earth, as a surface material code: sea and rivers, runways, towns by their
// streets and quarters, beaches, marsh, woods, bare rock, snow; else soil. A function of place and seed.

// Ground above is snow all the year [m]; falls toward the poles. Woods end kWoodsBelowSnow_m below.
double snow_line_m(double latitude_deg);

struct CoverSite {
  geo::GeoPoint place;
  geo::Vector3 upward;     // unit vector of the place on the sphere
  double height_m = 0.0;   // 0 or less: sea
  double steepness = 0.0;  // [m/m]
  double valley = 1.0;     // -1 water of a river, 0 valley floor, 1 no valley
};

// Without towns and airfields.
Material natural_cover(const CoverSite& site, std::uint32_t seed);

// What a town has at a place so many of its radii from its middle [0, 1.4]; nothing beyond its ragged edge.
Material town_cover(const CoverSite& site, double radii, Material natural, std::uint32_t seed);

// Runway, taxiway and apron; `natural` beside them.
Material airfield_cover(const Airfield& airfield, geo::GeoPoint place, Material natural);

// Rows of posts of one cell of the made-up earth: ground from the lattice, gullies, then rivers, then the level
// ground of airfields, then what covers it. Immutable once made; rows may be made by any thread in any order.
class LandscapeRows {
 public:
  LandscapeRows(LandscapeTiles& tiles, std::uint32_t seed, CellPlace place, int rows, int columns);

  // Heights [m] and material codes of a row of posts, from west to east.
  void make(int row, std::span<std::int16_t> posts_m, std::span<std::uint8_t> codes) const;

 private:
  struct Row;  // one row in the making
  void lay_ground(Row& row, const LandscapeLattice::Row& lattice) const;
  void lay_rivers(Row& row) const;
  void level_airfields(Row& row) const;
  Material cover(const Row& row, std::size_t column) const;

  std::uint32_t seed_;
  int rows_;
  int columns_;
  CellPlace place_;
  std::vector<std::shared_ptr<const TileFeatures>> features_;  // of the cell and its neighbours
  std::unique_ptr<LandscapeLattice> lattice_;
  std::vector<double> longitudes_deg_;
  std::vector<double> cosines_, sines_;                // of the longitudes
  std::vector<std::vector<const RiverPiece*>> bands_;  // pieces that may touch rows of the lattice
  std::vector<const Town*> towns_;                     // that may touch the cell
  std::vector<const Airfield*> airfields_;
};

// The region that scripts/start flies in; config/routes/default.route goes along its coast.
struct DefaultLandscape {
  static constexpr int kSouth_deg = 36, kWest_deg = -124;
  static constexpr int kCellsNorth = 4, kCellsEast = 4;
  static constexpr std::uint64_t kSeed = 12;
};

struct MadeCell {
  model::terrain::Cell cell;
  model::terrain::Culture culture;  // at the cell's posts
};

// A made-up earth: coasts, ranges, rivers that run to the sea in valleys of their own, towns, airfields, woods.
// Height and cover are functions of place and seed alone (and of the box, for an island), so cells made one by one
// meet without a seam, and a post has one height whatever the spacing of the cell it is in. Not for navigation.
// Broad shapes hang on a lattice of 30 arc seconds (landscape_tiles.hpp), joined by a cubic spline and cut post by
// post by gullies down to some 100 m. Safe for any number of threads.
class Landscape {
 public:
  // With an island's box, land falls to the sea before the box's edge.
  explicit Landscape(std::uint64_t seed, std::optional<LandscapeBox> island = std::nullopt);

  // The cell at `rows` x `columns` posts (rows - 1 and columns - 1 divide 3600). Sea is 0 m, land at least 1 m;
  // a river's water may be at 0 m near its mouth. The bits do not depend on `threads` (at least 1).
  MadeCell make(CellPlace place, int rows, int columns, int threads = 1) const;
  model::terrain::Cell cell(CellPlace place, int rows, int columns) const { return make(place, rows, columns).cell; }

  // Rivers, towns and airfields of one degree by one degree.
  std::shared_ptr<const TileFeatures> features(CellPlace place) const { return tiles_->features(place); }
  std::shared_ptr<const ReliefTile> relief(CellPlace place) const { return tiles_->relief(place); }

  // False when no post of the cell can be land; may say true of a cell that is all sea.
  bool may_have_land(CellPlace place) const;

 private:
  std::uint32_t seed_;
  std::unique_ptr<LandscapeTiles> tiles_;
};

}  // namespace yars::worldgen
