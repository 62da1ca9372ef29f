// The broad shapes of one cell on a lattice of 30 arc seconds, joined by a uniform cubic B-spline: smooth, with its
// slope. Lattice and post positions are integers of the whole earth, so neighbouring cells compute equal bits.
#pragma once

#include <functional>
#include <vector>

#include "model/terrain/cell.hpp"
#include "model/terrain/gullies.hpp"

namespace yars::model::terrain {

class LandscapeLattice {
 public:
  LandscapeLattice(CellPlace place, const std::function<double(geo::GeoPoint)>& height_m);

  // Adds the relief of gullies at each lattice point, down the slope between its neighbours.
  void cut(const Gullies& gullies);

  struct Ground {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;  // [-180, 180)
    double height_m = 0.0;
    Slope slope;
  };

  // Row `post` of `intervals` northward from the cell's south edge; then places along it eastward.
  void choose_row(int post, int intervals);
  Ground at_column(int post, int intervals) const;

 private:
  static constexpr int kPerDegree = 120;
  static constexpr int kMargin = 2;  // nodes beyond the cell: the spline's, and their neighbours
  static constexpr int kNodes = kPerDegree + 2 * kMargin + 1;  // a side

  static std::size_t slot(int row, int column) {
    return static_cast<std::size_t>(row) * kNodes + static_cast<std::size_t>(column);
  }
  geo::GeoPoint node(int row, int column) const;

  int first_row_;     // lattice row of the earth, from the south pole
  int first_column_;  // lattice column, from the antimeridian eastward
  std::vector<double> heights_m_;
  double latitude_deg_ = 0.0;
  double east_per_node_m_ = 0.0;
  std::vector<double> row_m_;         // the spline along the chosen row, at lattice columns
  std::vector<double> row_change_m_;  // its change northward, per lattice step
};

}  // namespace yars::model::terrain
