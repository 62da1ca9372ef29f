// Elevation files: which files of a folder hold elevation, and the cells that the name, the header or the entries of
// such a file state.
// Input: the path of a file. Output: its cells, each a CellFile; what kind of file it is.
// Names: `wLLL/nBB.dtN` (N 0 to 2) and `wLLL/nBB.jp2` state their cell. LLL and BB: longitude and latitude [deg] of its
//   south-west corner, after w or e and n or s. `wLLL/nBB.jp2` is a pack (formats/pack.hpp). HGT files have N36W122 in
//   their names (corner_in_name() in formats/hgt.hpp). Upper and lower case are equal.
// Headers and entries: DTED of other names, `.ded` files, rasters (.tif, .tiff, .img, other .jp2), zip and gzip
// archives. Errors: each message names the file. Source: docs/terrain.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::terrain {

// Formats of elevation files, in order of preference among files of equal spacing.
enum class CellFormat : std::uint8_t { dted, hgt, ded, pack, compressed_hgt, raster };

// The elevation file of a cell.
struct CellFile {
  std::filesystem::path path;
  CellFormat format = CellFormat::dted;
  int posts_per_degree = 0;       // intervals of posts along a meridian, in the file; 0: known only after reading
  int posts_per_degree_east = 0;  // intervals along a parallel; 0: known only after reading
  double covered = 1.0;           // fraction of the cell that the file spans; below 1 for rasters only
  std::optional<std::filesystem::path> culture = {};  // its culture file (culture.hpp), set by the index
  // Rasters only, set by the index: other rasters with posts of this cell, best first. They fill its voids.
  std::vector<std::filesystem::path> others = {};
  // True if the file spans less than 99 % of the cell. A raster that lacks 1 of 200 rows and 1 of 200 columns is whole.
  bool is_part() const { return covered < 0.99; }
};

// A cell that a file holds. A raster with `covered` 0 has only posts on an edge of the cell.
struct FoundCell {
  CellCorner corner;
  CellFile file;
};

// Cell and format that the names of a file and its folder state. cell_named() returns nullopt if they state no cell.
struct NamedCell {
  CellCorner corner;
  CellFormat format = CellFormat::dted;
  int level = -1;  // DTED level; -1 for other formats
};
std::optional<NamedCell> cell_named(const std::string& folder, const std::string& file);

enum class ElevationKind : std::uint8_t {
  none,         // no elevation by its name
  readable,     // cells_in_file() reads it
  archive,      // .zip, .gz: cells_in_file() reads it if there is HGT in it
  unplaced,     // a name of HGT that states no cell
  convertible,  // elevation by its name; not read from a folder, but as a file of its own, through GDAL
  foreign       // elevation by its name, in a form that is not read
};
ElevationKind elevation_kind(const std::filesystem::path& path);

// The cells of a file. A file of any other name is read as DTED if it begins so, else as a raster.
// Empty: an archive without elevation. Errors: the file cannot be used; the message says why.
error::Expected<std::vector<FoundCell>> cells_in_file(const std::filesystem::path& path);

}  // namespace yars::model::terrain
