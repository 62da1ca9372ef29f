#include "model/terrain/gdal/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/terrain/gdal/georeference.hpp"
#include "model/terrain/gdal/open_raster.hpp"
#include "model/terrain/gdal/raster_cover.hpp"

namespace yars::model::terrain::gdal {

// Encodes heights as 16-bit multiples of a unit. If a height does not fit, the unit is increased and all earlier posts
// are rounded again.
class CellPosts {
 public:
  // All posts begin as voids. With `whole_metres` the unit is 1 m, else the smallest multiple of 0.1 m with
  // which all heights fit.
  CellPosts(int rows, int columns, bool whole_metres);

  // Stores a height [m MSL]. NaN leaves the post void. A height within 0.05 m of 0 becomes 0 (sea).
  void put(int row, int column, double height_m);
  // Gives the posts the smallest unit of the posts with fractions, for a further raster with fractions.
  void allow_fractions();

  int rows() const { return static_cast<int>(posts_.size()) / columns_; }
  int columns() const { return columns_; }
  bool is_void(int row, int column) const { return posts_[index(row, column)] == kNoHeight; }
  bool has_void(int first_row, int first_column, int end_row, int end_column) const;
  bool has_void() const { return has_void(0, 0, rows(), columns_); }
  bool on_edge(int row, int column) const {
    return row == 0 || column == 0 || row == rows() - 1 || column == columns_ - 1;
  }
  bool has_void_edge() const {
    return has_void(0, 0, 1, columns_) || has_void(rows() - 1, 0, rows(), columns_) || has_void(0, 0, rows(), 1) ||
           has_void(0, columns_ - 1, rows(), columns_);
  }

  double unit_m() const { return tenths_ / 10.0; }
  std::vector<std::int16_t> take() { return std::move(posts_); }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  std::int16_t rounded(double height_m) const;
  void coarsen(double height_m);

  int columns_;
  int tenths_;  // [0.1 m] unit
  std::vector<std::int16_t> posts_;
};

namespace {
constexpr double kSea_m = 0.05;  // interpolated sea is not exactly 0; a larger bound would flood low ground
constexpr int kMaxPost = 32767;
}  // namespace

CellPosts::CellPosts(int rows, int columns, bool whole_metres)
    : columns_(columns),
      tenths_(whole_metres ? 10 : 1),
      posts_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), kNoHeight) {}

void CellPosts::put(int row, int column, double height_m) {
  if (std::isnan(height_m)) return;
  if (std::abs(height_m) > kMaxPost * unit_m()) coarsen(height_m);
  posts_[index(row, column)] = rounded(height_m);
}

void CellPosts::allow_fractions() {
  if (tenths_ != 10) return;
  int highest = 0;
  for (const std::int16_t post : posts_)
    if (post != kNoHeight) highest = std::max(highest, std::abs(static_cast<int>(post)));
  // Units that divide a metre keep whole metres.
  for (const int tenths : {1, 2, 5})
    if (tenths_ == 10 && highest * 10 <= kMaxPost * tenths) tenths_ = tenths;
  for (std::int16_t& post : posts_)
    if (post != kNoHeight && post != 0) post = rounded(post);
}

bool CellPosts::has_void(int first_row, int first_column, int end_row, int end_column) const {
  for (int row = first_row; row < end_row; ++row) {
    const auto begin = posts_.begin() + static_cast<std::ptrdiff_t>(index(row, first_column));
    if (std::find(begin, begin + (end_column - first_column), kNoHeight) != begin + (end_column - first_column))
      return true;
  }
  return false;
}

std::int16_t CellPosts::rounded(double height_m) const {
  if (std::abs(height_m) < kSea_m) return 0;
  const long units = std::lround(height_m / unit_m());
  if (units != 0) return static_cast<std::int16_t>(units);
  return height_m < 0 ? std::int16_t{-1} : std::int16_t{1};
}

void CellPosts::coarsen(double height_m) {
  const double old_m = unit_m();
  tenths_ = static_cast<int>(std::ceil(std::abs(height_m) * 10.0 / kMaxPost));
  for (std::int16_t& post : posts_)
    if (post != kNoHeight && post != 0) post = rounded(post * old_m);
}

namespace {

// The block of pixels nearest to a post, and the offset of the post from the block's centre.
struct NearestBlock {
  int column, row;
  double right, down;  // [blocks] offset in [-0.5, 0.5]
};

// Which void posts a CellReader fills.
enum class Reach : std::uint8_t {
  pixels,  // those within the pixels of the raster
  beside,  // those on an edge of the cell, at most one pixel beyond the centre of an outermost pixel
  corner   // the same, also where both a row and a column of pixels are missing
};

// Fills the void posts of a cell from one raster, in squares of kTile x kTile posts (tiles).
class CellReader {
 public:
  CellReader(const Raster& raster, const Grid& grid, Reach reach, CellPosts& posts)
      : raster_(raster),
        grid_(grid),
        reach_(reach),
        pixels_(posts_are_pixels(raster, grid.rows - 1, grid.columns - 1)),
        posts_(posts) {}

  // Output: the number of pixels with impossible heights.
  error::Expected<std::size_t> read() {
    if (const double pixels = pixels_in_cell(); pixels > kMaxPixelsPerCell) {
      std::array<char, 64> most{}, found{};
      std::snprintf(most.data(), most.size(), "at most %.0e pixels in a one-degree cell", kMaxPixelsPerCell);
      std::snprintf(found.data(), found.size(), "about %.0e", pixels);
      return error::fail(raster_.subject, most.data(), found.data(), "make larger pixels, as with `gdalwarp -tr`");
    }
    size_ = block_size();
    const PostRange range = touched_posts(raster_, grid_);
    for (int row = 0; row < grid_.rows; row += kTile)
      for (int column = 0; column < grid_.columns; column += kTile) {
        const int end_row = std::min(row + kTile, grid_.rows), end_column = std::min(column + kTile, grid_.columns);
        if (!range.overlaps(row, column, end_row, end_column)) continue;
        if (!posts_.has_void(row, column, end_row, end_column)) continue;
        if (const auto done = read_tile(row, column); !done) return tl::unexpected(done.error());
      }
    return impossible_;
  }

 private:
  static constexpr int kTile = 256;  // [posts] edge of a tile; bounds the memory for pixels

  // Bounds the time that a cell takes, because each of its pixels is read. These are about 0.5 m apart.
  static constexpr double kMaxPixelsPerCell = 4e10;

  // Pixels per post interval in the middle of the cell.
  PixelStep middle_step() const {
    const PostLattice middle(raster_.georeference, grid_, {grid_.rows / 2 - 1, grid_.columns / 2 - 1, 1, 1});
    return middle.step(0, 0);
  }

  // At most the pixels of the raster.
  double pixels_in_cell() const {
    const PixelStep step = middle_step();
    const double per_post = std::abs(step.column_north * step.row_east - step.column_east * step.row_north);
    const double whole = static_cast<double>(raster_.columns) * raster_.rows;
    return std::isfinite(per_post) ? std::min(whole, per_post * grid_.rows * grid_.columns) : whole;
  }

  // Blocks of at most half a post interval, so that their means keep all relief that the posts can represent.
  BlockSize block_size() const {
    const PixelStep step = middle_step();
    const auto blocks = [](double a, double b) {
      const double pixels = std::max(std::abs(a), std::abs(b));
      return std::isfinite(pixels) ? std::max(1, static_cast<int>(std::min(pixels, 1e4) / 2.0)) : 1;
    };
    return {blocks(step.column_north, step.column_east), blocks(step.row_north, step.row_east)};
  }

  int block_columns() const { return (raster_.columns + size_.across - 1) / size_.across; }
  int block_rows() const { return (raster_.rows + size_.along - 1) / size_.along; }

  error::Expected<void> read_tile(int first_row, int first_column) {
    const PostLattice lattice(raster_.georeference, grid_,
                              {first_row, first_column, std::min(kTile, grid_.rows - 1 - first_row),
                               std::min(kTile, grid_.columns - 1 - first_column)});
    const auto bounds = lattice.bounds();
    if (!bounds) return {};
    constexpr int kMargin = 2;  // [blocks] for neighbours of the outermost blocks and for PostLattice's error
    const Box around = blocks_within(*bounds, kMargin);
    if (around.columns <= 0 || around.rows <= 0) return {};
    const auto window = read_window(raster_, size_, around, counted_pixels(lattice, *bounds));
    if (!window) return tl::unexpected(window.error());
    impossible_ += window->impossible;
    const int end_row = std::min(first_row + kTile, grid_.rows);
    const int end_column = std::min(first_column + kTile, grid_.columns);
    for (int row = first_row; row < end_row; ++row)
      for (int column = first_column; column < end_column; ++column)
        if (posts_.is_void(row, column) && (reach_ == Reach::pixels || posts_.on_edge(row, column)))
          posts_.put(row, column, height_m(*window, lattice, row - first_row, column - first_column));
    return {};
  }

  // Pixels of a tile, so that no impossible height is counted in two tiles. In a raster whose rows are not parallels,
  // the pixels of a tile form a quadrilateral.
  CountedPixels counted_pixels(const PostLattice& lattice, const PixelBounds& bounds) const {
    if (const auto corners = lattice.corners(); corners && !raster_.georeference.is_wgs84_grid())
      return {blocks_within(bounds, 1), corners};
    return {blocks_within(bounds, 0), std::nullopt};
  }

  // Blocks within `bounds`, extended by `margin` blocks on each side. With margin 0, the last row and column of blocks
  // are left to the next tile, except at the end of the raster.
  Box blocks_within(const PixelBounds& bounds, int margin) const {
    const auto span = [&](double low, double high, int pixels, int count) {
      const int first = std::max(0, static_cast<int>(std::floor(low / pixels)) - margin);
      int end = static_cast<int>(std::min(std::floor(high / pixels), count - 1.0)) + margin;
      if (end >= count - 1) end = count;
      return std::pair(first, std::min(count, end) - first);
    };
    const auto [column, columns] = span(std::max(bounds.left, -1.0), bounds.right, size_.across, block_columns());
    const auto [row, rows] = span(std::max(bounds.top, -1.0), bounds.bottom, size_.along, block_rows());
    return {column, row, columns, rows};
  }

  std::optional<NearestBlock> nearest(const PixelPosition& position) const {
    constexpr double kSlack = 1e-6;  // [pixels] tolerance for rounding errors at the raster's edge
    const auto beyond = [](double pixel, int pixels) { return std::max(-pixel, pixel - pixels); };
    const double across_pixels = beyond(position.column, raster_.columns);
    const double along_pixels = beyond(position.row, raster_.rows);
    const bool within = across_pixels <= kSlack && along_pixels <= kSlack;
    const bool one_direction = across_pixels <= kSlack || along_pixels <= kSlack;
    if (!within && (reach_ == Reach::pixels || (reach_ == Reach::beside && !one_direction) ||
                    !(across_pixels <= size_.across / 2.0 + kSlack && along_pixels <= size_.along / 2.0 + kSlack)))
      return std::nullopt;
    // Within half a block of the raster's edge the outermost blocks are repeated.
    const double across = std::clamp(position.column / size_.across - 0.5, 0.0, block_columns() - 1.0);
    const double along = std::clamp(position.row / size_.along - 0.5, 0.0, block_rows() - 1.0);
    const auto column = static_cast<int>(std::lround(across));
    const auto row = static_cast<int>(std::lround(along));
    return NearestBlock{column, row, across - column, along - row};
  }

  double height_m(const HeightWindow& window, const PostLattice& lattice, int row, int column) const {
    const auto block = nearest(lattice.position(row, column));
    if (!block || !contains(window.blocks, *block)) return static_cast<double>(kMissing);
    const float middle_m = window.at(block->column, block->row);
    if (std::isnan(middle_m)) return static_cast<double>(kMissing);
    const double above_m = lattice.above_sea_level_m(row, column);
    if (pixels_) return static_cast<double>(middle_m) + above_m;
    if (is_summit(window, *block) && is_closest_post(*block, lattice.step(row, column)))
      return static_cast<double>(middle_m) + above_m;
    return between(window, *block) + above_m;
  }

  static bool contains(const Box& box, const NearestBlock& block) {
    return block.column >= box.first_column && block.row >= box.first_row &&
           block.column < box.first_column + box.columns && block.row < box.first_row + box.rows;
  }

  // Bilinear interpolation between the centres of blocks. Blocks without a height are left out.
  static double between(const HeightWindow& window, const NearestBlock& block) {
    const int column = block.column + (block.right < 0 ? -1 : 1);
    const int row = block.row + (block.down < 0 ? -1 : 1);
    const double right = std::abs(block.right);
    const double down = std::abs(block.down);
    double total = 0.0;
    double height_m = 0.0;
    const auto add = [&](int at_column, int at_row, double weight) {
      if (weight <= 0.0 || !contains(window.blocks, {at_column, at_row, 0, 0})) return;
      const float block_m = window.at(at_column, at_row);
      if (std::isnan(block_m)) return;
      total += weight;
      height_m += weight * static_cast<double>(block_m);
    };
    add(block.column, block.row, (1 - right) * (1 - down));
    add(column, block.row, right * (1 - down));
    add(block.column, row, (1 - right) * down);
    add(column, row, right * down);
    return height_m / total;
  }

  // True if the block's centre is within half a post interval of the post, both along the cell's rows and along its
  // columns: no other post is then nearer to the block's centre.
  bool is_closest_post(const NearestBlock& block, const PixelStep& step) const {
    const double right = block.right * size_.across;
    const double down = block.down * size_.along;
    const double area = step.column_north * step.row_east - step.column_east * step.row_north;
    if (area == 0.0) return false;
    const double north = (right * step.row_east - down * step.column_east) / area;
    const double east = (down * step.column_north - right * step.row_north) / area;
    return std::abs(north) <= 0.5 && std::abs(east) <= 0.5;
  }

  // True if no neighbouring block is higher and at least one is lower.
  static bool is_summit(const HeightWindow& window, const NearestBlock& block) {
    const float middle_m = window.at(block.column, block.row);
    bool any_lower = false;
    for (int row = block.row - 1; row <= block.row + 1; ++row)
      for (int column = block.column - 1; column <= block.column + 1; ++column) {
        if (!contains(window.blocks, {column, row, 0, 0})) continue;
        if (window.at(column, row) > middle_m) return false;
        any_lower = any_lower || window.at(column, row) < middle_m;
      }
    return any_lower;
  }

  const Raster& raster_;
  Grid grid_;
  Reach reach_;
  bool pixels_;  // true: each post is the centre of a pixel of the raster
  BlockSize size_;
  CellPosts& posts_;
  std::size_t impossible_ = 0;
};

}  // namespace

namespace {

std::optional<DtedDatums> dted_datums_of(GDALDatasetH dataset) {
  if (GDALGetDriverShortName(GDALGetDatasetDriver(dataset)) != std::string_view("DTED")) return std::nullopt;
  const auto field = [&](const char* name) {
    const char* const text = GDALGetMetadataItem(dataset, name, nullptr);
    return std::string(text == nullptr ? "" : text);
  };
  return DtedDatums{field("DTED_VerticalDatum"), field("DTED_HorizontalDatum")};
}

}  // namespace

bool available() {
  return true;
}

namespace {

void add_new(const std::vector<std::string>& texts, std::vector<std::string>& all) {
  for (const std::string& text : texts)
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
}

}  // namespace

error::Expected<RasterSummary> describe_raster(const std::filesystem::path& path) {
  const auto raster = open_raster(path);
  if (!raster) return tl::unexpected(raster.error());
  RasterSummary summary{cells_of(*raster), edges_of(*raster), dted_datums_of(raster->dataset.get())};
  if (summary.cells.empty())
    return error::fail(path.string(), "a raster with at least one pixel in a one-degree cell", "no such pixel");
  return summary;
}

error::Expected<RasterPosts> read_raster(const std::vector<std::filesystem::path>& rasters, int south_deg, int west_deg,
                                         int posts_per_degree_north, int posts_per_degree_east) {
  YARS_REQUIRE(rasters.empty(), ==, false);
  const Grid grid{south_deg, west_deg, posts_per_degree_north + 1, posts_per_degree_east + 1};
  std::optional<CellPosts> posts;
  RasterPosts read;
  std::filesystem::path open_path;  // one at a time, because a cell may have thousands of rasters
  error::Expected<Raster> opened{Raster{}};
  const auto fill = [&](const std::filesystem::path& path, Reach reach) -> error::Expected<void> {
    if (open_path.empty() || path != open_path) opened = open_raster(open_path = path);
    const auto& raster = opened;
    if (!raster) return tl::unexpected(raster.error());
    const bool whole = raster->whole_metres && posts_are_pixels(*raster, grid.rows - 1, grid.columns - 1);
    if (!posts)
      posts.emplace(grid.rows, grid.columns, whole);
    else if (!whole)
      posts->allow_fractions();
    add_new(raster->georeference.notes(), read.notes);
    const auto impossible = CellReader(*raster, grid, reach, *posts).read();
    if (!impossible) return tl::unexpected(impossible.error());
    if (reach == Reach::pixels) read.impossible += *impossible;
    return {};
  };
  if (const auto filled = fill(rasters.front(), Reach::pixels); !filled) return tl::unexpected(filled.error());
  for (auto other = rasters.begin() + 1; other != rasters.end() && posts->has_void(); ++other)
    if (const auto filled = fill(*other, Reach::pixels); !filled) add_new({filled.error().message()}, read.problems);
  for (const Reach reach : {Reach::beside, Reach::corner})
    for (auto raster = rasters.begin(); raster != rasters.end() && posts->has_void_edge(); ++raster)
      if (const auto filled = fill(*raster, reach); !filled) add_new({filled.error().message()}, read.problems);
  read.rows = grid.rows;
  read.columns = grid.columns;
  read.unit_m = posts->unit_m();
  read.posts = posts->take();
  return read;
}

}  // namespace yars::model::terrain::gdal
