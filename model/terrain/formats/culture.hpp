// Culture of a cell: surface materials, and the PNG tile that holds them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"

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

// What covers the ground of one cell: a surface material code of DFAD a post, rows from south to north, both edges
// included as in the elevation cell; its resolution may differ from that cell's.
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

// The project's own tile of culture: an indexed PNG beside the elevation cell, w122/n36.smc.png beside w122/n36.dt1,
// N36W122.smc.png beside N36W122.hgt. A pixel's number is the surface material code of a post; rows from north to
// south as in any picture, all four edges included; 2 to 10801 posts a side, whatever the elevation's. The palette
// is for eyes only.
inline constexpr int kMaxCulturePosts = 10801;  // a side: a third of an arc second

// Where the culture of a cell lies, given its elevation file (.zip and .gz are left off first).
std::filesystem::path culture_path(const std::filesystem::path& elevation);

// The same, if there is such a file.
std::optional<std::filesystem::path> find_culture(const std::filesystem::path& elevation);

// Reads a tile of culture. Errors: no indexed PNG, fewer than 2 or more than kMaxCulturePosts
// posts a side, a code above kLargestMaterial; the message says where.
error::Expected<Culture> read_culture(const std::filesystem::path& path, CellPlace place);

// Red, green, blue of a material; gray for codes without a meaning.
std::array<std::uint8_t, 3> material_colour(std::uint8_t code);

// Writes a tile of culture, with natural colours, so that any viewer shows a map.
// Errors: the file cannot be written.
error::Expected<void> write_culture(const std::filesystem::path& path, const Culture& culture);

}  // namespace yars::model::terrain
