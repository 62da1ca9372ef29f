// SRTM HGT elevation files (Shuttle Radar Topography Mission): reader, also of zip and gzip files, and writer.
// Input: heights, big-endian two's complement, rows from north to south, void -32768. Columns x rows: 1201 x 1201,
//   3601 x 3601, or 1801 x 3601 toward the poles.
//   The format has no header. The file's name gives the cell, and the file's length gives the post spacing.
// Output: a CellReading, in which impossible heights are voids (cell_reading.hpp); a file.
// Units: whole metres above mean sea level (assumed: EGM96). Frame: WGS84 (assumed).
// Errors: another length; an archive that is damaged or lacks the cell's entry; a file that cannot be written.
// Source: docs/spec/formats.md#hgt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain {

error::Expected<CellReading> read_hgt(const std::filesystem::path& path, CellCorner corner);

// Like read_hgt(), but from the bytes of a file. `subject` names the file in errors.
error::Expected<CellReading> parse_hgt(std::span<const std::byte> bytes, const std::string& subject, CellCorner corner);

// Posts of an HGT file of this length; zeros if no HGT file has this length.
GridSize hgt_grid_for_size(std::uintmax_t bytes);

// The cell that the name of a file states anywhere between other letters: N36W122.hgt, N36W122.SRTMGL1.hgt,
// N36W122hgt.zip, `N36W122 (1).hgt`, ASTGTMV003_N36W122_dem.hgt, n36_w122_1arc_v3.hgt. Upper and lower case are equal.
// nullopt: it states none, or several.
std::optional<CellCorner> corner_in_name(std::string_view name);

// Files in a zip or gzip archive.
struct PackedFiles {
  std::vector<CellCorner> cells;    // of the HGT files
  std::vector<std::string> others;  // names of files that are no HGT, without their folders
};
// The files of an archive. The name of an entry states the cell; in a gzip archive the name in its header does, else
// the archive's own name. Errors: the archive cannot be read or has over 64 MiB; a name of HGT that states no cell.
error::Expected<PackedFiles> packed_hgt_files(const std::filesystem::path& path);

// Reads a cell of such an archive. Decompression stops beyond the length of the largest HGT file, as a protection
// against zip bombs (archives that expand to fill the memory). Errors: a damaged archive, no entry for the cell,
// another length.
error::Expected<CellReading> read_compressed_hgt(const std::filesystem::path& path, CellCorner corner);

// Posts of a cell of an archive, from the uncompressed length that the archive states. Zeros if no HGT file has this
// length, or if the archive cannot be read.
GridSize compressed_hgt_grid(const std::filesystem::path& path, CellCorner corner);

// Returns the bytes of an HGT file. Requires 1201 x 1201 or 3601 x 3601 posts in units of 1 m.
std::vector<std::byte> hgt_bytes(const Cell& cell);

// Writes `tree`/N36W122.hgt (see lib/file/output_file.hpp), creates missing folders and returns the path.
error::Expected<std::filesystem::path> write_hgt(const std::filesystem::path& tree, const Cell& cell);

// "N36W122.hgt"
std::string hgt_name(CellCorner corner);

}  // namespace yars::model::terrain
