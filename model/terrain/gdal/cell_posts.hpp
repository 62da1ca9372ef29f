// Heights as the whole numbers that a cell holds. Private to this folder.
#pragma once

#include <cstdint>
#include <vector>

namespace yars::model::terrain::gdal {

// Begins with the finest unit and takes the next coarser one when a height does not fit: what is there then is rounded
// again.
class CellPosts {
 public:
  // All void; `whole_metres`: the unit is a metre, else the least multiple of a decimetre that holds all heights.
  CellPosts(int rows, int columns, bool whole_metres);

  // `height_m` NaN: stays void. Within 0.05 m of 0 m it is sea.
  void put(int row, int column, double height_m);

  double unit_m() const { return tenths_ / 10.0; }
  std::vector<std::int16_t> take() { return std::move(posts_); }

 private:
  std::int16_t rounded(double height_m) const;
  void coarsen(double height_m);

  int columns_;
  int tenths_;  // of a metre, a unit
  std::vector<std::int16_t> posts_;
};

}  // namespace yars::model::terrain::gdal
