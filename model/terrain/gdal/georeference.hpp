// Georeference of a raster, and the lattice of a cell's posts on its pixels.
#pragma once

#include <gdal.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/gdal/coordinate_operations.hpp"

namespace yars::model::terrain::gdal {

struct EarthPlace {
  double longitude_deg, latitude_deg;
};

// Where the pixels of a raster lie on the earth: WGS84 by PROJ, from whatever system the raster states (other datums,
// units, meridians and axes; projections). Where PROJ knows several ways there, the best that it can compute over the
// whole raster serves all of it; a ballpark, or a better way whose grid is not installed, becomes a warning.
// Pixels are counted from the corner of the first: its middle is 0.5, 0.5. Rows and columns may lie in any way.
// Private to this folder; one object serves one thread.
class Georeference {
 public:
  // Errors: no geotransform, no coordinate system, one that PROJ cannot bring to WGS84, ellipsoidal heights without a
  // geoid that PROJ has.
  Georeference() = default;
  static error::Expected<Georeference> of(GDALDatasetH dataset, const std::string& subject);

  // True if columns are meridians and rows are parallels of WGS84.
  bool is_plain() const { return !to_wgs84_ && pixel_from_data_[2] == 0.0 && pixel_from_data_[4] == 0.0; }

  // In place: columns become longitudes and rows latitudes [deg], and back. NaN where that is nowhere. Longitudes may
  // be off by whole turns.
  void to_earth(std::span<double> across, std::span<double> along) const;
  // `reference` is a place among them: of the turns of the earth all take that which brings it nearest to the raster.
  void to_pixels(std::span<double> across, std::span<double> along, EarthPlace reference) const;

  // What makes the raster's heights heights above mean sea level.
  double metres_of_a_unit() const { return metres_of_a_unit_; }  // 0: the coordinate system does not say
  bool points_down() const { return points_down_; }
  bool heights_are_ellipsoidal() const { return geoid_ != nullptr; }
  // [m] to be added to ellipsoidal heights at places; NaN where the geoid's grid ends.
  std::vector<double> above_sea_level_m(std::span<const double> longitudes_deg,
                                        std::span<const double> latitudes_deg) const;

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  error::Expected<void> read_system(GDALDatasetH dataset, const std::string& subject);
  error::Expected<void> read_vertical(PJ* vertical, PJ* horizontal, const std::string& subject);
  error::Expected<void> find_geoid(PJ* horizontal, const std::string& subject);
  error::Expected<void> find_way(PJ* horizontal, const std::string& subject);
  Net net_of_pixels() const;
  void find_turn(PJ* horizontal);
  void take_as_wgs84(bool longitude_first);
  void to_system(std::span<double> x, std::span<double> y) const;
  void from_system(std::span<double> x, std::span<double> y, double near_x) const;
  double near_middle(double x) const;

  ProjContext context_;  // outlives what is made in it
  Projection to_wgs84_;  // null: the system is WGS84 in degrees
  Projection geoid_;     // null: heights are above mean sea level
  std::array<double, 6> data_from_pixel_{}, pixel_from_data_{};
  std::array<int, 2> axis_{1, 2};  // of the system that the data's x and y are; negative: the other way
  double turn_ = 0.0;              // [units of x] a turn of the earth; 0: the raster is projected
  double middle_x_ = 0.0;
  double metres_of_a_unit_ = 0.0;
  bool points_down_ = false;
  bool longitude_first_ = false;  // of a system that is taken as WGS84
  int width_ = 0, height_ = 0;
  std::vector<std::string> warnings_;
};

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

// Where the posts of a part of a cell lie in a raster: exact every few posts, linear between (off by less than a
// hundredth of a pixel: a projection bends little over so short a way). Private to this folder.
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
