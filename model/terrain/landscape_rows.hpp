// Rows of posts of one cell of the made-up earth: ground from the lattice, gullies, then rivers, then the level
// ground of airfields, then what covers it. Immutable once made; rows may be made by any thread in any order.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model/terrain/culture.hpp"
#include "model/terrain/landscape_lattice.hpp"
#include "model/terrain/landscape_tiles.hpp"

namespace yars::model::terrain {

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

}  // namespace yars::model::terrain
