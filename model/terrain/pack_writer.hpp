// Packs a cell: `wLLL/nBB.jp2` (lossless, see jpeg2000.hpp; voids filled smoothly) and beside it `nBB.side` (see
// pack_side.hpp). The .side is written first: a .jp2 without one is never left.
// Errors of write_pack: the files cannot be written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/failure/error.hpp"
#include "model/terrain/cell.hpp"

namespace yars::model::terrain {

struct PackedCell {
  std::vector<std::byte> jp2;
  std::vector<std::byte> side;
};

failure::Expected<PackedCell> pack_cell(const Cell& cell);

// The path of the .jp2 below `tree`.
failure::Expected<std::filesystem::path> write_pack(const std::filesystem::path& tree, const Cell& cell);

// Below a tree: "w122/n36.jp2".
std::string pack_name(CellPlace place);

}  // namespace yars::model::terrain
