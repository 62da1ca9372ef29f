// What covers the ground of one cell: a surface material code of DFAD a post, rows from south to north, both edges
// included as in the elevation cell; its resolution may differ from that cell's.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/terrain/cell.hpp"

namespace yars::model::terrain {

// Surface material codes (DFAD). 14 to 31 are free; larger ones do not exist.
enum class Material : std::uint8_t {
  none = 0,
  metal = 1,
  part_metal = 2,
  stone = 3,
  composition = 4,
  earthen = 5,
  water = 6,
  sand = 7,
  rock = 8,
  asphalt = 9,
  soil = 10,
  marsh = 11,
  trees = 12,
  snow = 13,
};
inline constexpr std::uint8_t kLargestMaterial = 31;

class Culture {
 public:
  // Requires rows, columns >= 2, rows * columns codes, none above kLargestMaterial.
  Culture(CellPlace place, int rows, int columns, std::vector<std::uint8_t> codes);

  CellPlace place() const { return place_; }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  // Row by row; three bytes more may be read, so that a look-up can take four at once.
  std::span<const std::uint8_t> codes() const { return {codes_.data(), codes_.size() - kSpareBytes}; }
  // Every 2^reduction-th post, as far as the intervals divide.
  Culture reduced(int reduction) const;
  std::uint8_t code(int row, int column) const {
    return codes_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }
  // Of the post nearest to a place in the cell: degrees from its south-west corner, [0, 1], clamped.
  std::uint8_t nearest(double north_deg, double east_deg) const;
  std::size_t bytes() const { return sizeof(*this) + codes_.size(); }

 private:
  static constexpr std::size_t kSpareBytes = 3;

  CellPlace place_;
  int rows_;
  int columns_;
  std::vector<std::uint8_t> codes_;
};

}  // namespace yars::model::terrain
