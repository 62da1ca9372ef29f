// Lattice nodes of one cell and its surroundings joined by a uniform cubic B-spline: smooth ground, with its slope.
// Post positions are fractions of whole numbers of the earth, so neighbouring cells compute equal bits.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "model/terrain/landscape_relief.hpp"

namespace yars::model::terrain {

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

}  // namespace yars::model::terrain
