// One degree by one degree of elevation posts, and where such cells lie on the earth.
// Posts: rows from south to north, in a row from west to east, both edges included (neighbours repeat them),
// metres MSL, kVoidPost where the source has no height. Rows and columns may differ (DTED zones).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/geo/geodesic.hpp"

namespace yars::model::terrain {

inline constexpr std::int16_t kVoidPost = -32768;  // outside what DTED (-32767) and HGT can hold as a height
inline constexpr int kCellRows = 180;              // cells from pole to pole
inline constexpr int kCellColumns = 360;           // cells round the earth

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

class Cell {
 public:
  // Requires rows, columns >= 2 and rows * columns posts.
  Cell(CellPlace place, int rows, int columns, std::vector<std::int16_t> posts);

  CellPlace place() const { return place_; }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  std::span<const std::int16_t> posts() const { return posts_; }
  std::int16_t post(int row, int column) const {
    return posts_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }
  std::size_t voids() const { return voids_; }           // posts without a height
  std::size_t sea_posts() const { return sea_posts_; }   // posts at exactly 0 m
  std::int16_t lowest_m() const { return lowest_m_; }    // [m] of the posts that have a height; 0 when none has
  std::int16_t highest_m() const { return highest_m_; }  // [m]
  std::size_t bytes() const { return sizeof(*this) + posts_.size() * sizeof(std::int16_t); }

 private:
  CellPlace place_;
  int rows_;
  int columns_;
  std::vector<std::int16_t> posts_;
  std::size_t voids_ = 0;
  std::size_t sea_posts_ = 0;
  std::int16_t lowest_m_ = 0;
  std::int16_t highest_m_ = 0;
};

}  // namespace yars::model::terrain
