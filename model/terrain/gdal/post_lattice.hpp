// Where the posts of a part of a cell lie in a raster: exact every few posts, linear between (off by less than a
// hundredth of a pixel: a projection bends little over so short a way). Private to this folder.
#pragma once

#include <optional>
#include <vector>

#include "model/terrain/gdal/georeference.hpp"

namespace yars::model::terrain::gdal {

// A cell of one degree.
struct Grid {
  int south_deg = 0, west_deg = 0;
  int rows = 0, columns = 0;  // posts, both edges included
};

// Intervals from a post on; rows from the south.
struct PostBox {
  int first_row = 0, first_column = 0;
  int intervals_north = 0, intervals_east = 0;
};

struct PixelPlace {
  double column, row;  // from the corner of the first pixel; NaN: nowhere
};

// Pixels from a post to the next one.
struct PixelStep {
  double column_north, row_north, column_east, row_east;
};

struct PixelBounds {
  double left, right, top, bottom;  // [pixels]
};

class PostLattice {
 public:
  PostLattice(const Georeference& georeference, const Grid& grid, const PostBox& box);

  // Of a post of the box, counted from its first.
  PixelPlace place(int row, int column) const;
  PixelStep step(int row, int column) const;
  double above_sea_level_m(int row, int column) const;  // [m] to be added to heights
  std::optional<PixelBounds> bounds() const;            // nothing: all of it is nowhere

 private:
  static constexpr int kStep = 16;  // [posts]

  struct Node {
    std::size_t south_west;          // of the four
    double north, east;              // [0, 1]
    double north_posts, east_posts;  // between the nodes
  };
  Node node_at(int row, int column) const;
  double between(const std::vector<double>& values, const Node& node) const;

  int rows_, columns_;  // of nodes
  int intervals_north_, intervals_east_;
  std::vector<double> column_, row_;  // [pixels]
  std::vector<double> above_m_;       // empty: heights are above mean sea level
};

}  // namespace yars::model::terrain::gdal
