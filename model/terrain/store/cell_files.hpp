// Elevation files of a folder: cells by file name, reading by format, index, and coverage.
// Input: a folder, or one file. Output: DirectoryIndex, the file of each cell; CellReading; sentences about problems.
// Names: `wLLL/nBB.dtN` (N 0 to 2), `N36W122.hgt`, `.hgt.zip`, `.hgt.gz` and `wLLL/nBB.jp2` state their cell.
//   The last is a pack (formats/pack.hpp). Case does not matter. The headers of `.ded` files and rasters (.tif, .tiff,
//   .jp2, .img) state their cells.
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
  int posts_per_degree = 0;       // along a meridian, not reduced; 0 = known only after reading
  int posts_per_degree_east = 0;  // along a parallel
  double covered = 1.0;           // fraction of the cell that the file spans; below 1 for rasters only
};

// Cell and format that file name and folder name state. cell_named() returns nullopt for names that state no cell.
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
// A reduced cell is two grids: the means of the original posts, and `peaks`, the highest of them. A reduced raster
// finer than one arc second is first averaged to about one arc second. In a pack, only the required wavelet levels are
// decoded. Files of other formats are read whole and then reduced.
error::Expected<CellReading> read_cell(const CellFile& file, CellCorner corner, int reduction = 0);

// True if `path` is a symbolic link with a target outside `root`. If the target does not exist, the path of the link is
// tested. Requires a canonical `root`.
bool links_outside(const std::filesystem::path& path, const std::filesystem::path& root);

// Elevation files of a folder: the file of each cell, by slot_of() of the cell. Every iteration has the same order.
using DirectoryIndex = std::map<std::size_t, CellFile>;

// Indexes a directory tree by file names in one walk. Only headers of .ded files, packs and rasters, and the lengths in
// zip and gzip archives, are read. Symbolic links to folders are not followed.
// Preference among files for one cell: at least 99 % of the cell spanned, finest spacing, order of CellFormat, order of
// paths. The posts of several files are not merged.
// `problems` receives a sentence for each unusable elevation file, sorted.
// Errors: the directory is missing or has no usable cell.
error::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory,
                                                std::vector<std::string>* problems = nullptr);

// The cells of one file. A name without a known pattern is read as a raster. Errors: the file cannot be read, or its
// headers state no usable cell.
error::Expected<DirectoryIndex> index_file(const std::filesystem::path& path);

// True if a cell of the index may lie within the region.
bool touches(const DirectoryIndex& index, const TerrainRegion& region);

// Bounding box of all cells in whole degrees. Cells at both sides of the antimeridian give -180 to 180.
struct Coverage {
  int south_deg = 0, north_deg = 0, west_deg = 0, east_deg = 0;
};

// Requires a non-empty index.
Coverage coverage_of(const DirectoryIndex& index);

// The coverage as text: "latitude 36 to 39, longitude -124 to -120". Requires a non-empty index.
std::string coverage_text(const DirectoryIndex& index);

}  // namespace yars::model::terrain
