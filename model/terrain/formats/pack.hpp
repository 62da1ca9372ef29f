// Reader and writer of packed cells, which `yars terrain pack` makes. A packed cell (a pack) is an elevation cell in
// two files, such as n36.jp2 and n36.side. The .jp2 has the heights in lossless JPEG 2000. The .side has voids, sea,
// edges, and peaks: the highest ground around each post of a coarser grid (pack_side.hpp).
// Input: both files and a reduction (r: every 2^r-th post); a cell to write.
// Output: a CellReading with peaks, if the reduction is above 0; both files.
// Accuracy: exact at reduction 0; see read_pack() for coarser grids.
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

// Reads every 2^reduction-th post of a packed cell. Reduction 0 gives the original cell bit for bit.
// At reductions above 0, finer wavelet levels are not decoded. Edges, voids, sea and peaks equal those of reduce().
// Heights inside the cell are the wavelet's low-pass, but at most as high as the peaks. Where only one dimension can be
// halved further, they are averaged along this dimension. The heights are sharper than the means of reduce(): rms
// difference 4 to 22 m in mountains with posts 3 arc seconds apart, at reductions 1 and 2.
// A reduction beyond the coarsest in the files gives the coarsest.
// Errors: one of the two files is missing or damaged, or they do not belong together.
error::Expected<CellReading> read_pack(const std::filesystem::path& path, CellCorner corner, int reduction);

// Like read_pack(), but from the bytes of both files. `subject` names the file in errors.
error::Expected<CellReading> parse_pack(std::span<const std::byte> jp2, std::span<const std::byte> side,
                                        const std::string& subject, CellCorner corner, int reduction);

// Rows and columns from the header of the .jp2; zeros if the header cannot be read.
GridSize pack_size(const std::filesystem::path& path);

struct PackedCell {
  std::vector<std::byte> jp2;
  std::vector<std::byte> side;
};

// Returns the bytes of both files. Voids are filled smoothly in the .jp2 and marked in the .side.
// Errors: the encoder fails.
error::Expected<PackedCell> pack_cell(const Cell& cell);

// Writes both files in the folder `tree`: first the .side, then the .jp2 (pack_name()). In this order no new .jp2 is
// left without its .side. Returns the path of the .jp2. Errors: the encoder fails, or a file cannot be written.
error::Expected<std::filesystem::path> write_pack(const std::filesystem::path& tree, const Cell& cell);

// Path of a cell's .jp2 relative to the folder `tree`: "w122/n36.jp2".
std::string pack_name(CellCorner corner);

}  // namespace yars::model::terrain
