#include "model/terrain/gdal/land_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "model/terrain/gdal/georeference.hpp"
#include "model/terrain/gdal/open_raster.hpp"

namespace yars::model::terrain::gdal {

namespace {
constexpr int kNoData = -1;  // value of a pixel without data

// Index into the legend by value of a pixel.
std::vector<std::uint8_t> classes_by_value(const std::vector<PixelClass>& legend) {
  std::vector<std::uint8_t> class_of(65536, kNoClass);
  for (std::size_t i = 0; i < legend.size(); ++i)
    for (const std::uint16_t value : legend[i].values) class_of[value] = static_cast<std::uint8_t>(i);
  return class_of;
}

// Pixels [first, end) along one direction.
struct Span {
  int first = 0, end = 0;
};

// Fills the posts without a class from one raster, in tiles of posts.
class CoverReader {
 public:
  CoverReader(const Raster& raster, const Grid& grid, const std::vector<PixelClass>& legend, CoverPosts& posts)
      : raster_(raster), grid_(grid), legend_(legend), class_of_(classes_by_value(legend)), posts_(posts) {}

  error::Expected<void> read() {
    const PostLattice middle(raster_.georeference, grid_, {grid_.rows / 2 - 1, grid_.columns / 2 - 1, 1, 1});
    const PixelStep step = middle.step(0, 0);
    const double pixels =
        std::max({std::hypot(step.column_north, step.row_north), std::hypot(step.column_east, step.row_east), 1.0});
    constexpr double kMaxPixels = 2048.0, kMaxPosts = 256.0;  // edge of a tile; bounds the memory
    const int tile = std::isfinite(pixels) ? static_cast<int>(std::clamp(kMaxPixels / pixels, 1.0, kMaxPosts)) : 256;
    const PostRange range = touched_posts(raster_, grid_);
    for (int row = range.first_row; row < range.end_row; row += tile)
      for (int column = range.first_column; column < range.end_column; column += tile) {
        const PostTile posts{row, column, std::min(row + tile, range.end_row),
                             std::min(column + tile, range.end_column)};
        if (auto done = read_tile(posts); !done) return done;
      }
    return {};
  }

 private:
  struct PostTile {
    int first_row, first_column, end_row, end_column;
  };

  error::Expected<void> read_tile(const PostTile& tile) {
    // The lattice has at least one interval in each direction, from which the steps follow.
    const int south = std::min(tile.first_row, grid_.rows - 2), west = std::min(tile.first_column, grid_.columns - 2);
    const PostLattice lattice(
        raster_.georeference, grid_,
        {south, west, std::max(1, tile.end_row - 1 - south), std::max(1, tile.end_column - 1 - west)});
    const auto bounds = lattice.bounds();
    if (!bounds) return {};
    const PixelStep step = lattice.step(0, 0);
    const double across = std::abs(step.column_north) + std::abs(step.column_east) + 1.0;
    const double along = std::abs(step.row_north) + std::abs(step.row_east) + 1.0;
    const Span columns = clipped(bounds->left - across, bounds->right + across, raster_.columns);
    const Span rows = clipped(bounds->top - along, bounds->bottom + along, raster_.rows);
    if (columns.first >= columns.end || rows.first >= rows.end) return {};
    const Box box{columns.first, rows.first, columns.end - columns.first, rows.end - rows.first};
    auto values = read_values(box);
    if (!values) return tl::unexpected(values.error());
    box_ = box;
    values_ = std::move(*values);
    const bool even = raster_.georeference.is_wgs84_grid();
    std::vector<Span> columns_of, rows_of;  // pixels of each column and row of posts, where both are parallel
    if (even) {
      for (int column = tile.first_column; column < tile.end_column; ++column)
        columns_of.push_back(around(lattice.position(0, column - west).column,
                                    lattice.step(0, column - west).column_east, raster_.columns));
      for (int row = tile.first_row; row < tile.end_row; ++row)
        rows_of.push_back(
            around(lattice.position(row - south, 0).row, lattice.step(row - south, 0).row_north, raster_.rows));
    }
    for (int row = tile.first_row; row < tile.end_row; ++row)
      for (int column = tile.first_column; column < tile.end_column; ++column) {
        const std::size_t post =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) + static_cast<std::size_t>(column);
        if (posts_.classes[post] != kNoClass) continue;
        if (even)
          vote_in(columns_of[static_cast<std::size_t>(column - tile.first_column)],
                  rows_of[static_cast<std::size_t>(row - tile.first_row)]);
        else
          vote_around(lattice.position(row - south, column - west), lattice.step(row - south, column - west));
        count_votes(post);
      }
    return {};
  }

  // Pixels whose centres are at most half a step from a post; the pixel at the post if there is none.
  static Span around(double position, double step, int pixels) {
    if (!std::isfinite(position)) return {};
    const double half = 0.5 * std::abs(step);
    const Span found{static_cast<int>(std::ceil(std::clamp(position - half - 0.5, 0.0, pixels - 0.0))),
                     static_cast<int>(std::ceil(std::clamp(position + half - 0.5, 0.0, pixels - 0.0)))};
    if (found.first < found.end) return found;
    const double at = std::floor(position);
    return at >= 0.0 && at < pixels ? Span{static_cast<int>(at), static_cast<int>(at) + 1} : Span{};
  }

  void vote_in(const Span& columns, const Span& rows) {
    for (int row = rows.first; row < rows.end; ++row)
      for (int column = columns.first; column < columns.end; ++column) vote(column, row);
  }

  static Span clipped(double low, double high, int pixels) {
    return {static_cast<int>(std::clamp(std::floor(low), 0.0, static_cast<double>(pixels))),
            static_cast<int>(std::clamp(std::ceil(high), 0.0, static_cast<double>(pixels)))};
  }

  error::Expected<std::vector<std::int32_t>> read_values(const Box& box) const {
    std::vector<std::int32_t> values(box.area());
    const auto valid = read_pixels(raster_, box, GDT_Int32, values.data(), "classes");
    if (!valid) return tl::unexpected(valid.error());
    if (raster_.no_data_value)
      std::replace(values.begin(), values.end(), static_cast<std::int32_t>(*raster_.no_data_value), kNoData);
    for (std::size_t i = 0; i < valid->size(); ++i)
      if ((*valid)[i] == 0) values[i] = kNoData;
    return values;
  }

  void vote_around(const PixelPosition& post, const PixelStep& step) {
    const double area = step.column_north * step.row_east - step.column_east * step.row_north;
    if (!std::isfinite(post.column + post.row) || area == 0.0) return;
    const double across = 0.5 * (std::abs(step.column_north) + std::abs(step.column_east));
    const double along = 0.5 * (std::abs(step.row_north) + std::abs(step.row_east));
    const Span columns = clipped(post.column - across - 0.5, post.column + across + 0.5, raster_.columns);
    const Span rows = clipped(post.row - along - 0.5, post.row + along + 0.5, raster_.rows);
    bool any = false;
    for (int row = rows.first; row < rows.end; ++row)
      for (int column = columns.first; column < columns.end; ++column) {
        const double right = column + 0.5 - post.column, down = row + 0.5 - post.row;
        const double north = (right * step.row_east - down * step.column_east) / area;
        const double east = (down * step.column_north - right * step.row_north) / area;
        if (north < -0.5 || north >= 0.5 || east < -0.5 || east >= 0.5) continue;
        vote(column, row);
        any = true;
      }
    const auto at_post = [](double position) { return static_cast<int>(std::floor(position)); };
    const int column = at_post(post.column), row = at_post(post.row);
    if (!any && column >= 0 && row >= 0 && column < raster_.columns && row < raster_.rows) vote(column, row);
  }

  void vote(int column, int row) {
    const std::int32_t value =
        values_[static_cast<std::size_t>(row - box_.first_row) * static_cast<std::size_t>(box_.columns) +
                static_cast<std::size_t>(column - box_.first_column)];
    if (value == kNoData) return;
    const bool known = value >= 0 && value < static_cast<std::int32_t>(class_of_.size()) &&
                       class_of_[static_cast<std::size_t>(value)] != kNoClass;
    if (!known) {
      ++posts_.unknown[value];
      return;
    }
    const std::uint8_t found = class_of_[static_cast<std::size_t>(value)];
    if (votes_[found]++ == 0) candidates_.push_back(found);
  }

  // Sets a post by the votes, and clears them.
  void count_votes(std::size_t post) {
    struct Best {
      std::uint8_t number = kNoClass;
      std::uint32_t votes = 0;
      void take(std::uint8_t other, std::uint32_t others) {
        if (others > votes || (others == votes && other < number)) *this = {other, others};
      }
    };
    Best of_all, of_land;
    std::uint32_t all = 0, water = 0;
    for (const std::uint8_t candidate : candidates_) {
      const std::uint32_t votes = votes_[candidate];
      const bool wet = legend_[candidate].water;
      all += votes;
      if (wet) water += votes;
      if (!wet) of_land.take(candidate, votes);
      of_all.take(candidate, votes);
      votes_[candidate] = 0;
    }
    candidates_.clear();
    posts_.classes[post] = of_all.number;
    posts_.land[post] = of_land.number;
    posts_.water[post] = static_cast<std::uint8_t>(all > 0 ? (255ULL * water + all / 2) / all : 0ULL);
  }

  const Raster& raster_;
  const Grid grid_;
  const std::vector<PixelClass>& legend_;
  const std::vector<std::uint8_t> class_of_;  // by value of a pixel
  CoverPosts& posts_;
  Box box_;                           // pixels of values_
  std::vector<std::int32_t> values_;  // of the tile
  std::array<std::uint32_t, kMaxClasses> votes_{};
  std::vector<std::uint8_t> candidates_;  // classes with votes
};

}  // namespace

error::Expected<CoverSummary> describe_cover(const std::filesystem::path& path) {
  const auto raster = open_raster(path, Content::classes);
  if (!raster) return tl::unexpected(raster.error());
  CoverSummary summary{cells_of(*raster)};
  if (summary.cells.empty())
    return error::fail(path.string(), "a raster with at least one pixel in a one-degree cell", "no such pixel");
  const RasterCell& cell = summary.cells.front();
  constexpr int kPosts = 1200;
  const PostLattice middle(raster->georeference, {cell.south_deg, cell.west_deg, kPosts + 1, kPosts + 1},
                           {kPosts / 2, kPosts / 2, 1, 1});
  const PixelStep step = middle.step(0, 0);
  summary.pixels_per_degree = kPosts * std::hypot(step.column_north, step.row_north);
  return summary;
}

error::Expected<CoverPosts> read_cover(const std::vector<std::filesystem::path>& rasters,
                                       const std::vector<PixelClass>& legend, int south_deg, int west_deg,
                                       int posts_per_degree_north, int posts_per_degree_east) {
  YARS_REQUIRE(rasters.empty(), ==, false);
  YARS_REQUIRE(legend.size(), <=, kMaxClasses);
  const Grid grid{south_deg, west_deg, posts_per_degree_north + 1, posts_per_degree_east + 1};
  const std::size_t count = static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns);
  CoverPosts posts{grid.rows,
                   grid.columns,
                   std::vector<std::uint8_t>(count, kNoClass),
                   std::vector<std::uint8_t>(count, kNoClass),
                   std::vector<std::uint8_t>(count, 0),
                   {},
                   {}};
  for (const std::filesystem::path& path : rasters) {
    if (std::find(posts.classes.begin(), posts.classes.end(), kNoClass) == posts.classes.end()) break;
    const auto raster = open_raster(path, Content::classes);
    if (!raster) return tl::unexpected(raster.error());
    for (const std::string& note : raster->georeference.notes())
      if (std::find(posts.notes.begin(), posts.notes.end(), note) == posts.notes.end()) posts.notes.push_back(note);
    if (const auto done = CoverReader(*raster, grid, legend, posts).read(); !done) return tl::unexpected(done.error());
  }
  return posts;
}

}  // namespace yars::model::terrain::gdal
