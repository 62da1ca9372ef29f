// Georeference of a raster: transforms between pixels and WGS84, and pixel positions of the posts of a cell.
// Used in this folder only.
// Input: coordinate system and geotransform of a GDAL dataset. The geotransform is GDAL's affine transform from pixels
//   to coordinates of the system.
// Output: longitudes and latitudes [deg], pixel positions, geoid corrections [m]. The geoid is the surface of mean sea
//   level. EGM96 is the model of the geoid that is used.
// Frame: pixel positions count from the outer corner of the first pixel. The centre of this pixel is (0.5, 0.5).
// Errors: no geotransform or a singular one, no coordinate system that PROJ knows, no PROJ operation to WGS84,
//   ellipsoidal heights for which PROJ has no geoid.
// Threads: one thread per object and its copies.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/gdal/coordinate_operations.hpp"
#include "model/terrain/gdal/gdal_library.hpp"

namespace yars::model::terrain::gdal {

struct EarthPosition {
  double longitude_deg, latitude_deg;
};

// Transform between the pixels of a raster and WGS84 by PROJ. It supports any datum, unit, prime meridian, axis order
// and projection. The whole raster uses one PROJ operation, selected at sample points by operation_between().
// Notes: the operation is a ballpark transformation; a better operation lacks its grid file; heights are ellipsoidal
// and are converted with the geoid.
class Georeference {
 public:
  Georeference() = default;
  static error::Expected<Georeference> of(GDALDatasetH dataset, const std::string& subject);

  // True if columns are meridians and rows are parallels of WGS84.
  bool is_wgs84_grid() const { return !to_wgs84_ && pixel_from_data_[2] == 0.0 && pixel_from_data_[4] == 0.0; }

  // Converts in place: pixel columns in `across` to longitudes, pixel rows in `along` to latitudes [deg].
  // Longitudes are not wrapped. A position becomes NaN if PROJ cannot convert it, or if the result is beyond +-90.5 deg
  // of latitude or +-1080 deg of longitude.
  void to_earth(std::span<double> across, std::span<double> along) const;
  // Inverse of to_earth(). `reference`: a position near the positions to convert. In a raster whose coordinates are
  // angles, `reference` is first shifted by a multiple of 360 degrees to within 180 degrees of the raster's middle.
  // Then each position is shifted to within 180 degrees of `reference`. NaN: a position that PROJ cannot convert.
  void to_pixels(std::span<double> across, std::span<double> along, EarthPosition reference) const;

  // Properties of the heights.
  double metres_per_unit() const { return metres_per_unit_; }  // unit of heights; 0: the system states none
  bool points_down() const { return points_down_; }            // true: values are depths, positive downwards
  bool heights_are_ellipsoidal() const { return geoid_ != nullptr; }
  // [m] Correction to add to a height above the ellipsoid of the system. The sum is the height above mean sea level, by
  // the geoid EGM96. NaN outside the grid of the geoid. Requires heights_are_ellipsoidal().
  std::vector<double> above_sea_level_m(std::span<const double> longitudes_deg,
                                        std::span<const double> latitudes_deg) const;

  const std::vector<std::string>& notes() const { return notes_; }

 private:
  error::Expected<void> read_system(const std::string& wkt, const std::string& subject);
  error::Expected<void> read_vertical(PJ* vertical, PJ* horizontal, const std::string& subject);
  error::Expected<void> find_geoid(PJ* horizontal, const std::string& subject);
  error::Expected<void> find_operation(PJ* horizontal, const std::string& subject);
  SamplePoints sample_pixels() const;
  void find_period(PJ* horizontal);
  void treat_as_wgs84(bool longitude_first);
  void to_system(std::span<double> x, std::span<double> y) const;
  void from_system(std::span<double> x, std::span<double> y, double near_x) const;
  double near_middle(double x) const;

  // Copies share these. The context is declared first, because it must outlive the PROJ objects.
  std::shared_ptr<PJ_CONTEXT> context_;
  std::shared_ptr<PJ> to_wgs84_;  // null: coordinates count as degrees of WGS84
  std::shared_ptr<PJ> geoid_;     // null: heights are above mean sea level
  // Geotransform and its inverse. "Data" are coordinates of the system in GDAL's axis order: x, y.
  std::array<double, 6> data_from_pixel_{}, pixel_from_data_{};
  std::array<int, 2> axis_{1, 2};  // axis of the system, 1 or 2, for x and for y of the data; negative: reversed
  double period_ = 0.0;            // [units of x] a full turn of 360 degrees; 0: the coordinates are projected
  double middle_x_ = 0.0;          // [units of x] x at the raster's middle
  double metres_per_unit_ = 0.0;
  bool points_down_ = false;
  bool longitude_first_ = false;  // true: the system is treated as WGS84, and its first axis is the longitude
  int width_ = 0, height_ = 0;
  std::vector<std::string> notes_;
};

// Grid of posts of a cell of 1 x 1 degree.
struct Grid {
  int south_deg = 0, west_deg = 0;
  int rows = 0, columns = 0;  // posts, both edges included
};

// Rectangular part of a cell: its south-west post and its numbers of post intervals. Rows count from the south, columns
// from the west.
struct PostBox {
  int first_row = 0, first_column = 0;
  int intervals_north = 0, intervals_east = 0;
};

struct PixelPosition {
  double column, row;  // [pixels] from the corner of the first pixel; NaN: the transform has no result
};

// Corners of a quadrilateral, in sequence around it.
using PixelCorners = std::array<PixelPosition, 4>;

// Signed offset [pixels], in columns and in rows, from a post to its northern and to its eastern neighbour.
struct PixelStep {
  double column_north, row_north, column_east, row_east;
};

struct PixelBounds {
  double left, right, top, bottom;  // [pixels]
};

// Pixel positions of the posts of a part of a cell. Every 16th post in both directions, and the last one, is a node
// and is transformed exactly. Positions between nodes are interpolated bilinearly. Error: less than 0.01 pixel, because
// projections are nearly linear over 16 posts.
class PostLattice {
 public:
  PostLattice(const Georeference& georeference, const Grid& grid, const PostBox& box);

  // Rows and columns count from the first post of the box.
  PixelPosition position(int row, int column) const;
  PixelStep step(int row, int column) const;
  double above_sea_level_m(int row, int column) const;  // [m] to add to an ellipsoidal height; 0 for other heights
  std::optional<PixelBounds> bounds() const;            // of all nodes; nullopt: no node has a position
  std::optional<PixelCorners> corners() const;          // of the box; nullopt: a corner has no position

 private:
  static constexpr int kStep = 16;  // [posts] from node to node; a larger step increases the error

  struct Node {
    std::size_t south_west;          // index of the south-west node of the four nodes around the post
    double north, east;              // position of the post: 0 at the south-west node, 1 at its neighbour node
    double north_posts, east_posts;  // post intervals between the nodes
  };
  Node node_at(int row, int column) const;
  double between(const std::vector<double>& values, const Node& node) const;

  int rows_, columns_;  // number of nodes
  int intervals_north_, intervals_east_;
  std::vector<double> column_, row_;  // [pixels] positions of the nodes
  std::vector<double> above_m_;       // [m] corrections at the nodes; empty: heights are above mean sea level
};

}  // namespace yars::model::terrain::gdal
