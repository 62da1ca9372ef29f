// One degree by one degree of elevation posts.
// Posts: rows from south to north, in a row from west to east, both edges included (neighbours repeat them),
// metres MSL, kVoidPost where the source has no height. Rows and columns may differ (DTED zones).
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
  // Requires rows, columns >= 2 and rows * columns posts.
  Cell(CellPlace place, int rows, int columns, const std::vector<std::int16_t>& posts);

  CellPlace place() const { return place_; }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  std::size_t post_count() const { return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_); }
  std::int16_t post(int row, int column) const { return blocks_.post(row, column); }
  std::vector<std::int16_t> posts() const;  // all, row by row
  const PostBlocks& blocks() const { return blocks_; }
  std::size_t voids() const { return voids_; }           // posts without a height
  std::size_t sea_posts() const { return sea_posts_; }   // posts at exactly 0 m
  std::int16_t lowest_m() const { return lowest_m_; }    // [m] of the posts that have a height; 0 when none has
  std::int16_t highest_m() const { return highest_m_; }  // [m]
  std::size_t bytes() const { return sizeof(*this) + blocks_.bytes(); }

 private:
  CellPlace place_;
  int rows_;
  int columns_;
  PostBlocks blocks_;
  std::size_t voids_ = 0;
  std::size_t sea_posts_ = 0;
  std::int16_t lowest_m_ = 0;
  std::int16_t highest_m_ = 0;
};

}  // namespace yars::model::terrain
