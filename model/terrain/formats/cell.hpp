// Elevation cell: the grid of posts (height samples) of one degree by one degree, and coarser grids made from it.
// Inputs: posts row by row, and their unit. Outputs: posts, numbers of voids and sea posts, grids of means and peaks.
// Units: posts are multiples of `unit_m` [m] above mean sea level; positions are in degrees. Frame: WGS84.
// Grid: rows from south to north, columns from west to east, both edges included.
// Errors: a violated requirement ends the program (YARS_REQUIRE). Threads: immutable after construction.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/memory/line_vector.hpp"

namespace yars::model::terrain {

inline constexpr int kCellRows = 180;     // cells from pole to pole
inline constexpr int kCellColumns = 360;  // cells around the earth

// South-west corner of a cell in whole degrees: south [-90, 89], west [-180, 179].
struct CellCorner {
  int south_deg = 0;
  int west_deg = 0;
  friend bool operator==(CellCorner, CellCorner) = default;
};

// Numbers of rows and columns; zeros: not known.
struct GridSize {
  int rows = 0;
  int columns = 0;
};

// Index of a cell in a table of all cells of the earth (a slot): row by row from the south-west. corner_of_slot() is
// the inverse.
constexpr std::size_t slot_of(CellCorner corner) {
  return static_cast<std::size_t>(corner.south_deg + 90) * kCellColumns +
         static_cast<std::size_t>(corner.west_deg + 180);
}
constexpr CellCorner corner_of_slot(std::size_t slot) {
  return {static_cast<int>(slot / kCellColumns) - 90, static_cast<int>(slot % kCellColumns) - 180};
}

// The cell that contains a point. Longitude is wrapped and latitude clamped. A point on a shared edge belongs to the
// cell north or east of that edge. Requires finite coordinates.
CellCorner cell_containing(geo::GeoPoint point);

// The posts of a grid in blocks of 4 rows x 8 columns. A block of heights is 64 bytes, one cache line. A block begins
// every 3 rows and 7 columns, so that blocks overlap by one post. The four posts around any position therefore lie in
// one block. Two adjacent heights of a row lie in 32 adjacent bits, which SIMD sampling gathers at once.
// Memory: 32/21 of a grid without overlaps.
template <class Post>
class Blocks {
 public:
  static constexpr int kRows = 4, kColumns = 8;        // posts of a block
  static constexpr int kRowStep = 3, kColumnStep = 7;  // [posts] from one block to the next
  static constexpr std::size_t kPosts = static_cast<std::size_t>(kRows) * kColumns;

  // Requires rows, columns >= 2 and rows * columns posts, row by row.
  Blocks(int rows, int columns, std::span<const Post> posts);

  Post post(int row, int column) const {
    const int block_row = std::min(row / kRowStep, block_rows_ - 1);
    const int block_column = std::min(column / kColumnStep, block_columns_ - 1);
    const Block& block = blocks_[static_cast<std::size_t>(block_row) * static_cast<std::size_t>(block_columns_) +
                                 static_cast<std::size_t>(block_column)];
    return block.posts[static_cast<std::size_t>(row - block_row * kRowStep) * kColumns +
                       static_cast<std::size_t>(column - block_column * kColumnStep)];
  }

  // Copies the posts of a row. Requires an entry for each column of the grid.
  void copy_row(int row, std::span<Post> posts) const;

  // The posts of all blocks, for SIMD gathers. Post (row, column) with row < rows - 1 and column < columns - 1 is entry
  // (row / 3 * block_columns + column / 7) * 32 + row % 3 * 8 + column % 7, with integer division. Its northern
  // neighbour is entry + 8, its eastern neighbour entry + 1. A spare block follows the last one.
  const Post* data() const { return blocks_.front().posts.data(); }
  int block_columns() const { return block_columns_; }
  std::size_t bytes() const { return blocks_.size() * sizeof(Block); }

 private:
  struct alignas(kPosts * sizeof(Post)) Block {
    std::array<Post, kPosts> posts;
  };
  int block_rows_;
  int block_columns_;
  memory::CacheAlignedVector<Block> blocks_;
};
using PostBlocks = Blocks<std::int16_t>;  // heights
using CodeBlocks = Blocks<std::uint8_t>;  // surface material codes

// Upper bound of the posts around each tile of a grid. A tile is a square of kTile x kTile intervals between posts.
class Ceilings {
 public:
  static constexpr int kTile = 16;  // [posts] side of a tile
  static constexpr int kReach = 8;  // [posts] the bound holds this far beyond a tile's edges

  // Requires rows, columns >= 2 and rows * columns posts, row by row.
  Ceilings(int rows, int columns, std::span<const std::int16_t> posts);

  // No post within kReach rows and columns of position (row, column) is higher. Positions beyond the grid are clamped.
  std::int16_t around(float row, float column) const {
    const int tile_row = std::clamp(static_cast<int>(row) / kTile, 0, tile_rows_ - 1);
    const int tile_column = std::clamp(static_cast<int>(column) / kTile, 0, tile_columns_ - 1);
    return highest_[static_cast<std::size_t>(tile_row) * static_cast<std::size_t>(tile_columns_) +
                    static_cast<std::size_t>(tile_column)];
  }
  std::size_t bytes() const { return highest_.size() * sizeof(std::int16_t); }

 private:
  int tile_rows_, tile_columns_;
  std::vector<std::int16_t> highest_;
};

// Value of a void: a post without a height. Neither DTED nor HGT can store this value as a height.
inline constexpr std::int16_t kVoidPost = -32768;
inline constexpr int kMaxEdgePosts = 7201;  // maximum number of posts along an edge of a cell: 0.5 arc seconds apart

// Elevation posts of one degree by one degree, immutable.
// Posts are whole multiples of `unit_m` above mean sea level, or kVoidPost. The posts of an edge are in both cells that
// share the edge. The unit is 1 m, or less where the source has fractions of a metre. DTED cells at latitudes of 50
// degrees and more have fewer columns than rows.
class Cell {
 public:
  // Requires rows, columns >= 2, rows * columns posts and a unit above 0 m.
  Cell(CellCorner corner, int rows, int columns, const std::vector<std::int16_t>& posts, double unit_m = 1.0);

  CellCorner corner() const { return corner_; }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  std::size_t post_count() const { return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_); }
  double unit_m() const { return unit_m_; }                                           // [m] height of post value 1
  std::int16_t post(int row, int column) const { return blocks_.post(row, column); }  // [unit_m]
  std::vector<std::int16_t> posts() const;                                            // [unit_m] all, row by row
  const PostBlocks& blocks() const { return blocks_; }
  const Ceilings& ceilings() const { return ceilings_; }
  std::size_t voids() const { return voids_; }             // posts without a height
  std::size_t sea_posts() const { return sea_posts_; }     // posts at exactly 0 m
  double lowest_m() const { return lowest_ * unit_m_; }    // [m] voids left out; 0 m if all posts are void
  double highest_m() const { return highest_ * unit_m_; }  // [m] voids left out; 0 m if all posts are void
  std::size_t bytes() const { return sizeof(*this) + blocks_.bytes() + ceilings_.bytes(); }

 private:
  CellCorner corner_;
  int rows_;
  int columns_;
  double unit_m_;
  PostBlocks blocks_;
  Ceilings ceilings_;
  std::size_t voids_ = 0;
  std::size_t sea_posts_ = 0;
  std::int16_t lowest_ = 0;
  std::int16_t highest_ = 0;
};

// Returns the cell with heights rounded to whole metres. A post other than 0 (sea) does not become 0.
Cell in_whole_metres(const Cell& cell);

// Two coarser grids of a cell. A coarse post lies at every factor-th post of each dimension, the first and the last
// included.
// means: mean of the posts within half the new spacing in each dimension; voids are left out. Posts at exactly half the
//   new spacing have half weight. A coarse post on an edge is the mean of posts of that edge only, so that equal edges
//   of neighbouring cells stay equal.
//   The mean is 0 (sea) if sea posts have over half of the weight. Any other mean that rounds to 0 becomes -1 if it is
//   negative, else 1.
// peaks: the highest post less than one new spacing away in each dimension. Bilinear interpolation between peaks is
//   never below the original surface. Peaks are computed from the posts of their own cell only. So the peaks of two
//   neighbouring cells may differ on the shared edge.
// A coarse post is void only if all posts from which it is computed are void.
struct ReducedCell {
  Cell means;
  Cell peaks;
};

// Coarser grids with every 2^reduction-th post, reduction >= 0. A dimension is halved at most halvings() times.
ReducedCell reduce(const Cell& cell, int reduction);

// Coarser grids by any factors. Requires factors >= 1. Each must divide the number of intervals of its dimension.
ReducedCell reduce_by(const Cell& cell, int row_factor, int column_factor);

// Number of times that the number of intervals between posts can be halved without a remainder. Requires posts >= 2.
int halvings(int posts);

// Number of posts along a dimension after min(reduction, halvings(posts)) halvings.
int reduced_posts(int posts, int reduction);

}  // namespace yars::model::terrain
