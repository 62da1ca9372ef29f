// Relief of the made-up earth: broad shapes, tiles of a lattice of 30 arc seconds, the spline through it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/terrain/formats/cell.hpp"
#include "worldgen/terrain/gullies.hpp"

namespace yars::worldgen {

using model::terrain::CellPlace;

// The box of whole cells that is made as one island: how far inside it a place lies. Beyond a box all is sea, since
// a cell without a file is; an edge at a pole, or where a box goes round the earth, is none.
struct LandscapeBox {
  int south_deg = -90;  // [-90, 89]
  int west_deg = -180;  // [-180, 179]
  int cells_north = 180;
  int cells_east = 360;

  // [km] to the nearest edge, round the corners in an arc; negative outside, very large without an edge.
  double inside_km(geo::GeoPoint place) const;
};

// The broad shapes of the made-up earth, from noise on the sphere: coasts with bays, capes and islands, a plain,
// ranges in chains along the coast with valleys between. A function of place, seed and box alone.
class BroadRelief {
 public:
  // With a box, land falls to the sea before the box's edge: the box holds islands.
  explicit BroadRelief(std::uint32_t seed, std::optional<LandscapeBox> island = std::nullopt)
      : seed_(seed), island_(island) {}

  // [m], negative under the sea, before valleys, gullies and rivers.
  double height_m(geo::GeoPoint place) const;

 private:
  struct Shore {
    double coast_km;  // way inland of the coast, negative at sea
    double fade;      // [0, 1] of mountains and hills
  };
  Shore beside_edge(double coast_km, geo::GeoPoint place, geo::Vector3 bent) const;
  double noise(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves = 1) const;
  double ridges(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves) const;

  std::uint32_t seed_;
  std::optional<LandscapeBox> island_;
};

// One degree of the lattice of 30 arc seconds that the made-up earth hangs on: the broad shapes, cut by the larger
// valleys. Node (0, 0) is the south-west corner; a tile owns 120 x 120 nodes, its neighbours the next ones.
// Tiles one row beyond the poles exist, for the splines that end there. Nodes have whole numbers of the earth, so
// that every tile and cell computes the same bits for the same place.
inline constexpr int kTileNodes = 120;           // a side, owned
inline constexpr double kTileMetres = 111195.0;  // [m] a degree of a sphere of 6371 km: shape only, no navigation
inline constexpr double kNodeMetres = kTileMetres / kTileNodes;

// Node of the earth: row from the south pole, column from the antimeridian, wrapped. Longitude [-180, 180).
geo::GeoPoint lattice_node(int row, int column);

// Metres eastward in a degree of longitude; kept from zero at the poles, where no slope makes sense.
double east_m_per_degree(double latitude_deg);

// The neighbour so many cells north and east; longitude wraps, latitude does not.
CellPlace neighbour_of(CellPlace place, int north, int east);

class ReliefTile {
 public:
  ReliefTile(CellPlace place, const BroadRelief& broad, const Gullies& valleys);

  CellPlace place() const { return place_; }
  // [m] at a node of the tile or of the ring about it, rows and columns -1 to 120; the ring has no valleys.
  double height_m(int row, int column) const { return heights_m_[slot(row, column)]; }
  // Steepest of the two slopes at a node of the tile [m/m].
  double steepness(int row, int column) const;
  geo::GeoPoint node(int row, int column) const;

 private:
  static constexpr int kSide = kTileNodes + 2;
  static std::size_t slot(int row, int column) {
    return static_cast<std::size_t>(row + 1) * kSide + static_cast<std::size_t>(column + 1);
  }

  CellPlace place_;
  std::vector<float> heights_m_;
};

// Lattice nodes of one cell and its surroundings joined by a uniform cubic B-spline: smooth ground, with its slope.
// Post positions are fractions of whole numbers of the earth, so neighbouring cells compute equal bits.
class LandscapeLattice {
 public:
  // `tile_at` gives the tile of a place, also one row beyond the poles. `columns` posts from west to east.
  LandscapeLattice(CellPlace place, int columns, const std::function<const ReliefTile&(CellPlace)>& tile_at);

  struct Ground {
    double height_m = 0.0;
    Slope slope;
  };

  // A row of posts: `post` of `intervals` northward from the cell's south edge.
  class Row {
   public:
    Row(const LandscapeLattice& lattice, int post, int intervals);
    double latitude_deg() const { return latitude_deg_; }
    Ground at(int column) const;

   private:
    const LandscapeLattice* lattice_;
    double latitude_deg_;
    double east_per_node_m_;
    std::vector<double> value_m_;   // the spline along the row, at lattice columns
    std::vector<double> change_m_;  // its change northward, per lattice step
  };

  // Longitude of a column of posts, [-180, 180).
  double longitude_deg(int column) const { return columns_[static_cast<std::size_t>(column)].longitude_deg; }

 private:
  static constexpr int kMargin = 2;                            // nodes beyond the cell that its splines reach
  static constexpr int kNodes = kTileNodes + 2 * kMargin + 1;  // a side

  struct Column {
    int first;  // lattice column of the first tap
    double longitude_deg;
    std::array<double, 4> value;
    std::array<double, 4> change;
  };

  CellPlace place_;
  std::vector<double> heights_m_;
  std::vector<Column> columns_;
};

}  // namespace yars::worldgen
