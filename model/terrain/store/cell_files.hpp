// Index of the elevation files of a folder, coverage of the index, reading of a cell by the format of its file.
// Input: a folder, or one file. Output: a DirectoryIndex (the file of each cell); a CellReading; problems and notes as
//   sentences.
// Errors: each message names the file. Source: docs/terrain.md.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "model/terrain/store/elevation_files.hpp"

namespace yars::model::terrain {

// Reads a cell with the reader of its format, at every 2^reduction-th post (see reduce() in cell.hpp), reduction >= 0.
// A reduced cell is two grids: means of the original posts around each kept post, and `peaks`, the highest of them. If
// a raster is finer than one arc second, its reduction begins with averaging to about one arc second. In a pack, only
// the required wavelet levels are decoded. Files of other formats are read whole and then reduced. Voids of a raster
// are filled from CellFile::others.
error::Expected<CellReading> read_cell(const CellFile& file, CellCorner corner, int reduction = 0);

// True if `path` is a symbolic link with a target outside `root`. If the target does not exist, the path of the link is
// tested. Requires a canonical `root`.
bool links_outside(const std::filesystem::path& path, const std::filesystem::path& root);

// Elevation files of a folder: the file of each cell, by slot_of() of the cell. Every iteration has the same order.
using DirectoryIndex = std::map<std::size_t, CellFile>;

// Indexes a directory tree in one walk. Headers are read of DTED files whose names state no cell, of .ded files, packs
// and rasters, and the lists of zip and gzip archives. Symbolic links to folders are not followed.
// Of several files for one cell, one is used. Preference: at least 99 % of the cell spanned, then finest spacing, then
// order of CellFormat, then the shorter name, then order of paths. If it is a raster, other rasters fill its voids.
// `found` receives, sorted, a problem for each elevation file that cannot be used, for each finer file of a part of a
// cell that another file spans, for each culture file without its cell, and for each folder that cannot be read; and a
// note for each file that is not needed.
// Errors: the directory is missing or has no usable cell.
error::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory, FileSentences* found = nullptr);

// The cells of one file of any name. Errors: the file cannot be read, or holds no usable cell.
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
