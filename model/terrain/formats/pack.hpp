// Packed cells: reader and writer.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/formats/jpeg2000.hpp"

namespace yars::model::terrain {

// Reads a packed cell (see write_pack()) at a reduction. At 0 it is the packed cell bit for bit. Above, finer
// levels are not decoded: inside the cell heights are the wavelet's low-pass, at most the peak, in place of reduce()'s
// box mean (sharper: rms 4 to 22 m apart in 3-arc-second mountains at reductions 1 and 2); edges, voids, sea and peaks
// are those of reduce(). A reduction beyond what the cell holds gives its coarsest.
// Errors: one of the two files is missing, damaged, or belongs to another.
error::Expected<CellReading> read_pack(const std::filesystem::path& path, CellPlace place, int reduction);

// The same from memory; `subject` names the file in errors.
error::Expected<CellReading> parse_pack(std::span<const std::byte> jp2, std::span<const std::byte> side,
                                        const std::string& subject, CellPlace place, int reduction);

// Posts a side of the packed cell by the head of the .jp2; zeros when it has none.
GridSize pack_size(const std::filesystem::path& path);

struct PackedCell {
  std::vector<std::byte> jp2;
  std::vector<std::byte> side;
};

// Packs a cell: `wLLL/nBB.jp2` (lossless, see jpeg2000.hpp; voids filled smoothly) and beside it `nBB.side` (see
// pack_side.hpp). The .side is written first: a .jp2 without one is never left.
// Errors of write_pack: the files cannot be written.
error::Expected<PackedCell> pack_cell(const Cell& cell);

// The path of the .jp2 below `tree`.
error::Expected<std::filesystem::path> write_pack(const std::filesystem::path& tree, const Cell& cell);

// Below a tree: "w122/n36.jp2".
std::string pack_name(CellPlace place);

}  // namespace yars::model::terrain
