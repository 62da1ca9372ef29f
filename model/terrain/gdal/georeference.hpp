// Georeference of a raster: pixels to WGS84 and back, posts of a cell in pixels. Private to this folder.
// Input: coordinate system and geotransform of a GDAL dataset. Output: positions [deg], pixels, geoid heights [m].
// Frame: pixels count from the corner of the first pixel; its centre is 0.5, 0.5.
// Errors: no geotransform, no coordinate system, no operation to WGS84, ellipsoidal heights without a geoid in PROJ.
// Threads: one thread per object.
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

struct EarthPosition {
  double longitude_deg, latitude_deg;
};

// Transform between the pixels of a raster and WGS84 by PROJ. Any datum, unit, prime meridian, axis order and
// projection of the raster is supported. One operation, the best that PROJ can compute over the whole raster, is used
// for all of it. A ballpark transformation, or a better operation with a missing grid, gives a warning.
class Georeference {
 public:
  Georeference() = default;
  static error::Expected<Georeference> of(GDALDatasetH dataset, const std::string& subject);

  // True if columns are meridians and rows are parallels of WGS84.
  bool is_wgs84_grid() const { return !to_wgs84_ && pixel_from_data_[2] == 0.0 && pixel_from_data_[4] == 0.0; }

  // In place: columns become longitudes and rows latitudes [deg]. Positions off the earth become NaN. Longitudes may
  // differ by multiples of 360 degrees.
  void to_earth(std::span<double> across, std::span<double> along) const;
  // The inverse. `reference` is one of the positions. All longitudes take the multiple of 360 degrees that brings it
  // nearest to the raster.
  void to_pixels(std::span<double> across, std::span<double> along, EarthPosition reference) const;

  // Properties of the heights.
  double metres_per_unit() const { return metres_per_unit_; }  // 0: not stated by the coordinate system
  bool points_down() const { return points_down_; }
  bool heights_are_ellipsoidal() const { return geoid_ != nullptr; }
  // [m] to add to ellipsoidal heights for heights above mean sea level; NaN outside the geoid's grid.
  std::vector<double> above_sea_level_m(std::span<const double> longitudes_deg,
                                        std::span<const double> latitudes_deg) const;

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  error::Expected<void> read_system(GDALDatasetH dataset, const std::string& subject);
  error::Expected<void> read_vertical(PJ* vertical, PJ* horizontal, const std::string& subject);
  error::Expected<void> find_geoid(PJ* horizontal, const std::string& subject);
  error::Expected<void> find_operation(PJ* horizontal, const std::string& subject);
  SamplePoints sample_pixels() const;
  void find_period(PJ* horizontal);
  void treat_as_wgs84(bool longitude_first);
  void to_system(std::span<double> x, std::span<double> y) const;
  void from_system(std::span<double> x, std::span<double> y, double near_x) const;
  double near_middle(double x) const;

  ProjContext context_;  // outlives the objects made in it
  Projection to_wgs84_;  // null: the system is WGS84 in degrees
  Projection geoid_;     // null: heights are above mean sea level
  std::array<double, 6> data_from_pixel_{}, pixel_from_data_{};
  std::array<int, 2> axis_{1, 2};  // axes of the system for the data's x and y; negative: reversed
  double period_ = 0.0;            // [units of x] 360 degrees; 0: the raster is projected
  double middle_x_ = 0.0;
  double metres_per_unit_ = 0.0;
  bool points_down_ = false;
  bool longitude_first_ = false;  // axis order of a system that is treated as WGS84
  int width_ = 0, height_ = 0;
  std::vector<std::string> warnings_;
};

// Posts of a cell of one degree.
struct Grid {
  int south_deg = 0, west_deg = 0;
  int rows = 0, columns = 0;  // posts, both edges included
};

// Part of a cell: first post and number of intervals. Rows count from the south.
struct PostBox {
  int first_row = 0, first_column = 0;
  int intervals_north = 0, intervals_east = 0;
};

struct PixelPosition {
  double column, row;  // from the corner of the first pixel; NaN: not in the raster's system
};

// Distance in pixels from a post to its northern and its eastern neighbour.
struct PixelStep {
  double column_north, row_north, column_east, row_east;
};

struct PixelBounds {
  double left, right, top, bottom;  // [pixels]
};

// Pixel positions of the posts of a part of a cell: transformed exactly at every 16th post, bilinear between.
// Error: less than 0.01 pixel, because projections are nearly linear over 16 posts.
class PostLattice {
 public:
  PostLattice(const Georeference& georeference, const Grid& grid, const PostBox& box);

  // Rows and columns count from the first post of the box.
  PixelPosition position(int row, int column) const;
  PixelStep step(int row, int column) const;
  double above_sea_level_m(int row, int column) const;  // [m] to add to heights
  std::optional<PixelBounds> bounds() const;            // nullopt: no post has a position

 private:
  static constexpr int kStep = 16;  // [posts] between exact nodes; more posts raise the error

  struct Node {
    std::size_t south_west;          // index of the south-west node of the four
    double north, east;              // [0, 1] fractions between the nodes
    double north_posts, east_posts;  // posts between the nodes
  };
  Node node_at(int row, int column) const;
  double between(const std::vector<double>& values, const Node& node) const;

  int rows_, columns_;  // of nodes
  int intervals_north_, intervals_east_;
  std::vector<double> column_, row_;  // [pixels]
  std::vector<double> above_m_;       // empty: the raster's heights are above mean sea level
};

}  // namespace yars::model::terrain::gdal
