// SRTM HGT: reader, reader of zip and gzip, writer.
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

// Reads one SRTM cell: 1201 x 1201 or 3601 x 3601 heights, big-endian two's complement, rows from north to south,
// void -32768. The file has no header: its name is its place and its length tells the spacing.
// Errors: another length.
error::Expected<CellReading> read_hgt(const std::filesystem::path& path, CellPlace place);

// The same from memory; `subject` names the file in errors.
error::Expected<CellReading> parse_hgt(std::span<const std::byte> bytes, const std::string& subject, CellPlace place);

// Posts a side of a file of this length; 0 when no HGT file is that long.
int hgt_posts_for_size(std::uintmax_t bytes);

// Reads an SRTM cell out of `N36W122.hgt.zip` (the entry of that name; case does not matter) or `N36W122.hgt.gz`
// (whose own note of a name, if it has one, is that too).
// Only an entry that is as long as an HGT file is unpacked, and never more than that: a bomb is an error.
// Errors: a damaged archive, no such entry, another length; else those of read_hgt().
error::Expected<CellReading> read_packed_hgt(const std::filesystem::path& path, CellPlace place);

// Posts a side by the length that the archive states; 0 when it states none that an HGT file has.
int packed_hgt_posts(const std::filesystem::path& path);

// Writes a cell as SRTM HGT : 1201 x 1201 or 3601 x 3601 posts in whole metres, which it must have.
// Errors of write_hgt: the file cannot be written.
std::vector<std::byte> hgt_bytes(const Cell& cell);

// `tree`/N36W122.hgt, written as lib/file/output_file.hpp says; folders are made.
error::Expected<std::filesystem::path> write_hgt(const std::filesystem::path& tree, const Cell& cell);

// "N36W122.hgt"
std::string hgt_name(CellPlace place);

}  // namespace yars::model::terrain
