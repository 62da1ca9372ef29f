// Elevation cell of one degree: its place, its posts in blocks, and coarser grids of it.
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

// Where one-degree cells lie on the earth.

inline constexpr int kCellRows = 180;     // cells from pole to pole
inline constexpr int kCellColumns = 360;  // cells round the earth

// Named by the south-west corner: whole degrees, south [-90, 89], west [-180, 179].
struct CellPlace {
  int south_deg = 0;
  int west_deg = 0;
  friend bool operator==(CellPlace, CellPlace) = default;
};

// Position in a table of kCellRows x kCellColumns cells, and back.
constexpr std::size_t slot_of(CellPlace place) {
  return static_cast<std::size_t>(place.south_deg + 90) * kCellColumns + static_cast<std::size_t>(place.west_deg + 180);
}
constexpr CellPlace place_of_slot(std::size_t slot) {
  return {static_cast<int>(slot / kCellColumns) - 90, static_cast<int>(slot % kCellColumns) - 180};
}

// The cell that holds a point: longitude wrapped, latitude clamped; a point on a shared edge belongs to the cell
// north or east of it. Coordinates must be finite.
CellPlace cell_holding(geo::GeoPoint point);

// The posts of a grid in blocks of 4 rows x 8 columns, 64 bytes: one cache line. Blocks overlap by one post (they begin
// every 3 rows and 7 columns), so the four neighbours of any place lie in one line, and the two of a row side by side
// in one 32-bit word: what the fast look-up gathers. Costs 32/21 of the plain grid.
class PostBlocks {
 public:
  static constexpr int kRows = 4, kColumns = 8;        // posts of a block
  static constexpr int kRowStep = 3, kColumnStep = 7;  // posts from one block to the next
  static constexpr std::size_t kPosts = static_cast<std::size_t>(kRows) * kColumns;

  // `posts` row by row, rows * columns of them, both at least 2.
  PostBlocks(int rows, int columns, std::span<const std::int16_t> posts);

  std::int16_t post(int row, int column) const {
    const int block_row = std::min(row / kRowStep, block_rows_ - 1);
    const int block_column = std::min(column / kColumnStep, block_columns_ - 1);
    const Block& block = blocks_[static_cast<std::size_t>(block_row) * static_cast<std::size_t>(block_columns_) +
                                 static_cast<std::size_t>(block_column)];
    return block.posts[static_cast<std::size_t>(row - block_row * kRowStep) * kColumns +
                       static_cast<std::size_t>(column - block_column * kColumnStep)];
  }

  // For look-ups: post (row, column) with row < rows - 1, column < columns - 1 is entry
  // (row / 3 * block_columns + column / 7) * 32 + row % 3 * 8 + column % 7; its neighbour north is 8 entries further.
  const std::int16_t* data() const { return blocks_.front().posts.data(); }
  int block_columns() const { return block_columns_; }
  std::size_t bytes() const { return blocks_.size() * sizeof(Block); }

 private:
  struct alignas(64) Block {
    std::array<std::int16_t, kPosts> posts;
  };
  int block_rows_;
  int block_columns_;
  memory::LineVector<Block> blocks_;
};

inline constexpr std::int16_t kVoidPost = -32768;  // outside what DTED (-32767) and HGT can hold as a height

// One degree by one degree of elevation posts.
// Posts: rows from south to north, in a row from west to east, both edges included (neighbours repeat them),
// heights MSL in whole units, kVoidPost where the source has no height. A unit is a metre, or less where the source has
// fractions of one. Rows and columns may differ (DTED zones).
class Cell {
 public:
  // Requires rows, columns >= 2, rows * columns posts and a unit above 0 m.
  Cell(CellPlace place, int rows, int columns, const std::vector<std::int16_t>& posts, double unit_m = 1.0);

  CellPlace place() const { return place_; }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  std::size_t post_count() const { return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_); }
  double unit_m() const { return unit_m_; }                                           // [m] of a post
  std::int16_t post(int row, int column) const { return blocks_.post(row, column); }  // [unit_m]
  std::vector<std::int16_t> posts() const;                                            // all, row by row
  const PostBlocks& blocks() const { return blocks_; }
  std::size_t voids() const { return voids_; }             // posts without a height
  std::size_t sea_posts() const { return sea_posts_; }     // posts at exactly 0 m
  double lowest_m() const { return lowest_ * unit_m_; }    // [m] of the posts that have a height; 0 when none has
  double highest_m() const { return highest_ * unit_m_; }  // [m]
  std::size_t bytes() const { return sizeof(*this) + blocks_.bytes(); }

 private:
  CellPlace place_;
  int rows_;
  int columns_;
  double unit_m_;
  PostBlocks blocks_;
  std::size_t voids_ = 0;
  std::size_t sea_posts_ = 0;
  std::int16_t lowest_ = 0;
  std::int16_t highest_ = 0;
};

// The same heights in whole metres, rounded; what is not sea stays at least 1 m away from it.
Cell in_whole_metres(const Cell& cell);

// Coarser grids of a cell, co-sited with it: every factor-th post of a dimension, so that both edges stay.
// means: box mean over half the new spacing to either side (a post exactly there counts half), voids left out. Posts
//   of an edge take only posts of that edge and a corner only itself: neighbours with equal edges stay equal. Sea
//   (0 m) stays where more than half is sea; any other mean is at least one unit away from 0, with its sign.
// peaks: the highest post less than one new spacing away in each dimension: bilinear interpolation between peaks is
//   never below the original surface. They see their own cell alone: neighbours' peaks may differ along the edge.
// A post is void only where all posts that it takes are.
struct ReducedCell {
  Cell means;
  Cell peaks;
};

// Every 2^reduction-th post; a dimension whose intervals do not divide so often is reduced as far as they do.
// Requires reduction >= 0.
ReducedCell reduce(const Cell& cell, int reduction);

// Requires factors >= 1 that divide the intervals of their dimension.
ReducedCell reduce_by(const Cell& cell, int row_factor, int column_factor);

// How often the intervals between so many posts (>= 2) can be halved.
int halvings(int posts);

// `posts` along a dimension after that many halvings, as far as they go.
int reduced_posts(int posts, int reduction);

}  // namespace yars::model::terrain
