// One degree of the lattice of 30 arc seconds that the made-up earth hangs on: the broad shapes, cut by the larger
// valleys. Node (0, 0) is the south-west corner; a tile owns 120 x 120 nodes, its neighbours the next ones.
// Tiles one row beyond the poles exist, for the splines that end there. Nodes have whole numbers of the earth, so
// that every tile and cell computes the same bits for the same place.
#pragma once

#include <cstddef>
#include <vector>

#include "model/terrain/cell.hpp"
#include "model/terrain/gullies.hpp"
#include "model/terrain/landscape_broad.hpp"

namespace yars::model::terrain {

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

}  // namespace yars::model::terrain
