// Writes a cell as SRTM HGT (see hgt_reader.hpp): 1201 x 1201 or 3601 x 3601 posts in whole metres, which it must have.
// Errors of write_hgt: the file cannot be written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/failure/error.hpp"
#include "model/terrain/cell.hpp"

namespace yars::model::terrain {

std::vector<std::byte> hgt_bytes(const Cell& cell);

// `tree`/N36W122.hgt, written as lib/file/new_file.hpp says; folders are made.
failure::Expected<std::filesystem::path> write_hgt(const std::filesystem::path& tree, const Cell& cell);

// "N36W122.hgt"
std::string hgt_name(CellPlace place);

}  // namespace yars::model::terrain
