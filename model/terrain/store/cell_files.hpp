// Elevation files of a folder: the cell that a file name states, reading by format, index and coverage of the folder.
// Input: a folder, or one file. Output: a DirectoryIndex (the file of each cell); a CellReading; problems as sentences.
// Names: `wLLL/nBB.dtN` (N 0 to 2), `N36W122.hgt`, `.hgt.zip`, `.hgt.gz` and `wLLL/nBB.jp2` state their cell.
//   LLL and BB: longitude and latitude [deg] of the cell's south-west corner, after w or e and n or s.
//   `wLLL/nBB.jp2` is a pack (formats/pack.hpp). Names may be in upper or lower case. The headers of `.ded` files and
//   rasters (.tif, .tiff, .img, other .jp2) state their cells.
// Errors: each message names the file. Source: docs/terrain.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

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
};

// Cell and format that the names of a file and its folder state. cell_named() returns nullopt if they state no cell.
struct NamedCell {
  CellCorner corner;
  CellFormat format = CellFormat::dted;
  int level = -1;  // DTED level; -1 for other formats
};
std::optional<NamedCell> cell_named(const std::string& folder, const std::string& file);

// True for extensions of files that state their cells in headers.
bool is_ded_name(const std::filesystem::path& path);
bool is_raster_name(const std::filesystem::path& path);          // including .vrt
bool is_virtual_raster_name(const std::filesystem::path& path);  // .vrt, which index_directory() reports as a problem

// Reads a cell with the reader of its format, at every 2^reduction-th post (see reduce() in cell.hpp), reduction >= 0.
// A reduced cell is two grids: means of the original posts around each kept post, and `peaks`, the highest of them. If
// a raster is finer than one arc second, its reduction begins with averaging to about one arc second. In a pack, only
// the required wavelet levels are decoded. Files of other formats are read whole and then reduced.
error::Expected<CellReading> read_cell(const CellFile& file, CellCorner corner, int reduction = 0);

// True if `path` is a symbolic link with a target outside `root`. If the target does not exist, the path of the link is
// tested. Requires a canonical `root`.
bool links_outside(const std::filesystem::path& path, const std::filesystem::path& root);

// Elevation files of a folder: the file of each cell, by slot_of() of the cell. Every iteration has the same order.
using DirectoryIndex = std::map<std::size_t, CellFile>;

// Indexes a directory tree by file names in one walk. Only headers of .ded files, packs and rasters, and the lengths in
// zip and gzip archives, are read. Symbolic links to folders are not followed.
// Of several files for one cell, one is used. Preference: at least 99 % of the cell spanned, then finest spacing, then
// order of CellFormat, then order of paths.
// `problems` receives a sentence for each unusable elevation file and each folder that cannot be read, sorted.
// Errors: the directory is missing or has no usable cell.
error::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory,
                                                std::vector<std::string>* problems = nullptr);

// The cells of one file. A name without a known pattern is read as a raster. Errors: the file cannot be read, or its
// headers state no usable cell.
error::Expected<DirectoryIndex> index_file(const std::filesystem::path& path);

// True if a cell of the index may overlap the region.
bool touches(const DirectoryIndex& index, const TerrainRegion& region);

// The position of the same ground in a cell of the index. A position on the north or east edge of a cell lies in the
// next cell; without a file for that one, it is moved by the least possible step into the cell that has it as edge.
// Else the position itself.
geo::GeoPoint within_index(const DirectoryIndex& index, geo::GeoPoint position);

// Bounding box of all cells in whole degrees. Cells on both sides of the antimeridian give longitudes -180 to 180.
struct Coverage {
  int south_deg = 0, north_deg = 0, west_deg = 0, east_deg = 0;
};

// Requires a non-empty index.
Coverage coverage_of(const DirectoryIndex& index);

// The coverage as text: "latitude 36 to 39, longitude -124 to -120". Requires a non-empty index.
std::string coverage_text(const DirectoryIndex& index);

}  // namespace yars::model::terrain
