// Reads one SRTM cell: 1201 x 1201 or 3601 x 3601 heights, big-endian two's complement, rows from north to south,
// void -32768. The file has no header: its name is its place and its length tells the spacing.
// Errors: another length. Packed files: packed_hgt_reader.hpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "model/terrain/cell_reading.hpp"

namespace yars::model::terrain {

failure::Expected<CellReading> read_hgt(const std::filesystem::path& path, CellPlace place);

// The same from memory; `subject` names the file in errors.
failure::Expected<CellReading> parse_hgt(std::span<const std::byte> bytes, const std::string& subject, CellPlace place);

// Posts a side of a file of this length; 0 when no HGT file is that long.
int hgt_posts_for_size(std::uintmax_t bytes);

}  // namespace yars::model::terrain
