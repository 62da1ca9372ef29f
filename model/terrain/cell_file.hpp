// A file that holds the posts of one-degree cells, and what its name says: `wLLL/nBB.dtN` (N 0 to 2),
// `N36W122.hgt`, `N36W122.hgt.zip` and `.gz`, `wLLL/nBB.jp2` (a pack) name their cell; `.ded` files and rasters (.tif,
// .tiff, .jp2, .img) say it in their headers. Case does not matter.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "model/terrain/cell_reading.hpp"

namespace yars::model::terrain {

// In order of preference among files of equal spacing.
enum class CellFormat : std::uint8_t { dted, hgt, ded, pack, packed_hgt, raster };

struct CellFile {
  std::filesystem::path path;
  CellFormat format = CellFormat::dted;
  int posts_per_degree = 0;       // along a meridian, not reduced; 0 = not known before it is read
  int posts_per_degree_east = 0;  // along a parallel
  double covered = 1.0;           // share of the cell that the file spans; below 1 for rasters only
};

// The place that a file of this name in this folder serves; nothing when it is no cell's name.
struct NamedCell {
  CellPlace place;
  CellFormat format = CellFormat::dted;
  int level = -1;  // DTED level; -1 for others
};
std::optional<NamedCell> cell_named(const std::string& folder, const std::string& file);

// Files whose headers have to be opened to know their cells.
bool is_ded_name(const std::filesystem::path& path);
bool is_raster_name(const std::filesystem::path& path);          // .vrt among them
bool is_virtual_raster_name(const std::filesystem::path& path);  // .vrt: refused with a word

// Reads a cell by the reader of its format, at every 2^reduction-th post: see reduce.hpp for what that means and for
// CellReading::peaks, which reduction 0 does not have. Packs decode no more than they have to; rasters finer than an
// arc second are smoothed to that first when reduced; all others are read whole. Requires reduction >= 0.
failure::Expected<CellReading> read_cell(const CellFile& file, CellPlace place, int reduction = 0);

}  // namespace yars::model::terrain
