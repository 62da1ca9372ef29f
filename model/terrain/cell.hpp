// One degree by one degree of elevation posts.
// Posts: rows from south to north, in a row from west to east, both edges included (neighbours repeat them),
// heights MSL in whole units, kVoidPost where the source has no height. A unit is a metre, or less where the source has
// fractions of one. Rows and columns may differ (DTED zones).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/terrain/cell_place.hpp"
#include "model/terrain/post_blocks.hpp"

namespace yars::model::terrain {

inline constexpr std::int16_t kVoidPost = -32768;  // outside what DTED (-32767) and HGT can hold as a height

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

}  // namespace yars::model::terrain
