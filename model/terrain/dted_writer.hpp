// Writes a cell as DTED level 0, 1 or 2 (MIL-PRF-89020B): whole columns, sign-magnitude, right checksums.
// Errors of write_dted: the file cannot be written. The cell needs kPostsOfLevel[level] rows.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/failure/error.hpp"
#include "model/terrain/cell.hpp"

namespace yars::model::terrain {

std::vector<std::byte> dted_bytes(const Cell& cell, int level);

// `tree`/wLLL/nBB.dtN, written as lib/file/new_file.hpp says; folders are made.
failure::Expected<std::filesystem::path> write_dted(const std::filesystem::path& tree, const Cell& cell, int level);

// Below a tree: "w122/n36.dt1".
std::string dted_name(CellPlace place, int level);

// Columns of a cell of that level: fewer toward the poles.
int dted_columns(CellPlace place, int level);

}  // namespace yars::model::terrain
