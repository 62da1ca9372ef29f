// SRTM HGT elevation files (Shuttle Radar Topography Mission): reader, also of zip and gzip files, and writer.
// Input: 1201 x 1201 or 3601 x 3601 heights, big-endian two's complement, rows from north to south, void -32768.
//   The format has no header. The file's name gives the cell, and the file's length gives the post spacing.
// Output: a CellReading, in which impossible heights are voids (cell_reading.hpp); a file.
// Units: whole metres above mean sea level (assumed: EGM96). Frame: WGS84 (assumed).
// Errors: another length; an archive that is damaged or lacks the cell's entry; a file that cannot be written.
// Source: docs/spec/formats.md#hgt.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain {

error::Expected<CellReading> read_hgt(const std::filesystem::path& path, CellCorner corner);

// Like read_hgt(), but from the bytes of a file. `subject` names the file in errors.
error::Expected<CellReading> parse_hgt(std::span<const std::byte> bytes, const std::string& subject, CellCorner corner);

// Number of posts along an edge of an HGT file of this length; 0 if no HGT file has this length.
int hgt_posts_for_size(std::uintmax_t bytes);

// Reads `N36W122.hgt.gz`, or the entry `N36W122.hgt` of `N36W122.hgt.zip`, in upper or lower case. A gzip header with
// the name of another cell is an error. Decompression stops beyond the length of the largest HGT file, as a protection
// against zip bombs (archives that expand to fill the memory). Errors: a damaged archive, no such entry, another
// length.
error::Expected<CellReading> read_compressed_hgt(const std::filesystem::path& path, CellCorner corner);

// Number of posts along an edge, from the uncompressed length that the archive states. 0 if no HGT file has this
// length, or if the archive cannot be read.
int compressed_hgt_posts(const std::filesystem::path& path);

// Returns the bytes of an HGT file. Requires 1201 x 1201 or 3601 x 3601 posts in units of 1 m.
std::vector<std::byte> hgt_bytes(const Cell& cell);

// Writes `tree`/N36W122.hgt (see lib/file/output_file.hpp), creates missing folders and returns the path.
error::Expected<std::filesystem::path> write_hgt(const std::filesystem::path& tree, const Cell& cell);

// "N36W122.hgt"
std::string hgt_name(CellCorner corner);

}  // namespace yars::model::terrain
