// Elevation files: what a name says, reading by format, the index of a directory, its coverage.
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

// A file that holds the posts of one-degree cells, and what its name says: `wLLL/nBB.dtN` (N 0 to 2),
// `N36W122.hgt`, `N36W122.hgt.zip` and `.gz`, `wLLL/nBB.jp2` (a pack) name their cell; `.ded` files and rasters (.tif,
// .tiff, .jp2, .img) say it in their headers. Case does not matter.

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

// Reads a cell by the reader of its format, at every 2^reduction-th post: see cell.hpp for what that means and for
// CellReading::peaks, which reduction 0 does not have. Packs decode no more than they have to; rasters finer than an
// arc second are smoothed to that first when reduced; all others are read whole. Requires reduction >= 0.
error::Expected<CellReading> read_cell(const CellFile& file, CellPlace place, int reduction = 0);

// Whether a link leads out of a folder that a user has named: what is read from a folder lies in it.
// `root` is canonical. A link to nowhere counts by where it points; what is no link never leads out.
bool leads_out(const std::filesystem::path& path, const std::filesystem::path& root);

// Which elevation file serves which one-degree cell, found in one walk of a directory tree by names;
// only headers of .ded files, packs and rasters are opened, and the tail of packed HGT. Links to directories below
// the root are not followed. Where several files serve a cell, one that spans all of it (99 %) wins, then the finest
// spacing, then the format in the order of CellFormat, then the path in order; cells are not merged.
// Errors: the directory is missing or holds no cell. A file that looks like one and cannot be used is a problem.

// Files by slot_of(place): in order, so that whatever goes through them is deterministic.
using DirectoryIndex = std::map<std::size_t, CellFile>;

// `problems` gets a sentence for each file that looks like cells and cannot be used, in order of the sentences.
error::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory,
                                                std::vector<std::string>* problems = nullptr);

// The cells of a single file; one of an unknown name is taken for a raster. Errors: it holds none that can be used.
error::Expected<DirectoryIndex> index_file(const std::filesystem::path& path);

// What the cells of a folder cover, for people who look elsewhere.

// Whether any cell may lie within the region.
bool touches(const DirectoryIndex& index, const TerrainRegion& region);

// Whole degrees about all cells; longitudes as the cells have them.
struct Coverage {
  int south_deg = 0, north_deg = 0, west_deg = 0, east_deg = 0;
};

// Requires an index that is not empty.
Coverage coverage_of(const DirectoryIndex& index);

// "latitude 36 to 39, longitude -124 to -120". Likewise.
std::string coverage_text(const DirectoryIndex& index);

}  // namespace yars::model::terrain
