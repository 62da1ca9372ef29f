// Culture of a cell: a grid of covers, each a surface material with or without a share of water, and the indexed PNG
// that stores it.
// Input: an indexed PNG beside the elevation file. Output: one DFAD code per post, and the share of water if it is
// known. Grid: rows from south to north in memory, from north to south in the file; all edges included. Threads: a
// Culture is immutable. Source: docs/spec/formats.md#dfad; docs/generated_terrain.md, "Culture tiles".
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/file/text_file.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::terrain {

// Surface material codes of DFAD (digital feature analysis data). Codes 14 to 31 are free for users; larger codes are
// errors.
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
inline constexpr std::uint8_t kMaxMaterial = 31;

// Name of a code up to 13, "land" for 0; empty for the free codes.
std::string_view material_name(std::uint8_t code);
// The code of a name, or of a number up to kMaxMaterial; nullopt for any other text.
std::optional<std::uint8_t> material_of(std::string_view text);

// What covers a post: a material, and the share of water [0, 1], which is then known whatever the height. nullopt:
// posts at 0 m are sea, and the material water is water. The rest of the post has the material.
struct Cover {
  std::uint8_t material = 0;
  std::optional<double> water = std::nullopt;
};

// A cover as one byte of a culture file. The lower five bits are the material. The upper three are 0 where the share of
// water is not known, else 1 + the share in sixths.
inline constexpr int kWaterShift = 5;
inline constexpr int kWaterSteps = 6;
inline std::uint8_t cover_byte(const Cover& cover) {
  const unsigned share = cover.water ? 1U + static_cast<unsigned>(std::lround(kWaterSteps * *cover.water)) : 0U;
  return static_cast<std::uint8_t>(cover.material | share << kWaterShift);
}
constexpr Cover cover_of(std::uint8_t byte) {
  const int share = byte >> kWaterShift;
  Cover cover{static_cast<std::uint8_t>(byte & kMaxMaterial)};
  if (share > 0) cover.water = static_cast<double>(share - 1) / kWaterSteps;
  return cover;
}

// Cover of one cell, one byte per post (cover_byte()). Rows run from south to north, both edges included. The spacing
// of posts may differ from the elevation cell's.
class Culture {
 public:
  // Requires rows, columns >= 2 and rows * columns bytes.
  Culture(CellCorner corner, int rows, int columns, std::span<const std::uint8_t> bytes);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  const CodeBlocks& blocks() const { return blocks_; }
  bool has_water() const { return has_water_; }  // shares of water of any post
  std::vector<std::uint8_t> posts() const;       // the bytes of all, row by row
  // Returns the culture with every 2^reduction-th post. Each dimension is halved up to `reduction` times. Halving stops
  // when the number of intervals is odd, or when fewer than two intervals would remain.
  Culture reduced(int reduction) const;
  Cover post(int row, int column) const { return cover_of(blocks_.post(row, column)); }
  // Cover of the nearest post. Degrees count from the south-west corner and are clamped to [0, 1].
  Cover nearest(double north_deg, double east_deg) const;
  std::size_t bytes() const { return sizeof(*this) + blocks_.bytes(); }

 private:
  CellCorner corner_;
  int rows_;
  int columns_;
  CodeBlocks blocks_;
  bool has_water_;
};

inline constexpr int kMaxCulturePosts = 10801;  // per edge, 1/3 arc second apart; bounds the memory for a file

// The culture file of an elevation file: w122/n36.smc.png for w122/n36.dt1, N36W122.smc.png for N36W122.hgt.zip.
std::filesystem::path culture_path(const std::filesystem::path& elevation);

// True for names that end as those of culture files do, in upper or lower case.
bool is_culture_name(const std::filesystem::path& path);

// Path of the folder's entry with the name of culture_path(), in upper or lower case. nullopt if there is no such
// entry. An entry that is not a regular file is found, too; read_culture() then fails.
std::optional<std::filesystem::path> find_culture(const std::filesystem::path& elevation, file::FolderNames& names);
std::optional<std::filesystem::path> find_culture(const std::filesystem::path& elevation);

// Reads a culture file: a pixel's palette index is the byte of a post. The palette's colours are ignored, except that
// bytes with a share of water need the palette of write_culture().
// Errors: not an indexed PNG, fewer than 2 or more than kMaxCulturePosts posts a side, a byte above kMaxMaterial with
// another palette. The message gives column and row of the first wrong one, counted from 0 at the north-west corner.
error::Expected<Culture> read_culture(const std::filesystem::path& path, CellCorner corner);

// Red, green, blue of a material; gray for the free codes.
std::array<std::uint8_t, 3> material_colour(std::uint8_t code);

// Removes all culture files of an elevation file, with names in upper or lower case. Errors: a file cannot be removed.
error::Expected<void> remove_culture(const std::filesystem::path& elevation);

// Writes a culture file, with the colours of material_colour() as its palette, those of shares of water mixed with that
// of water, and creates missing folders.
error::Expected<void> write_culture(const std::filesystem::path& path, const Culture& culture);

}  // namespace yars::model::terrain
