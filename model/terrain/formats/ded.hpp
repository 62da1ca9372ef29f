// Reader of MultiGen DED elevation files (`.ded`). A file contains several cells.
// Input: a file. Output: the list of its cells; one cell as a CellReading.
// Units: posts in metres above mean sea level; -32767 and -32768 are void.
// Errors: a wrong magic number or file length; a cell that is not 1 x 1 deg on whole degrees; posts that do not span
//   the cell. Such a cell is not resampled (project choice): resampling would shift posts sideways by up to half their
//   spacing and open cracks between cells.
// Source: docs/spec/formats.md#ded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain {

// One cell of a file: an entry of the file's table of cells.
struct DedCell {
  CellCorner corner;
  int rows = 0;
  int columns = 0;
  std::uint64_t offset = 0;  // [bytes] position in the file of the cell's first post
  std::size_t bytes() const { return 2 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
};

// Reads the table of cells. Posts are not read.
error::Expected<std::vector<DedCell>> ded_cells(const std::filesystem::path& path);

// Reads one cell. Errors: those of ded_cells(), or no cell has its south-west corner at `corner`.
error::Expected<CellReading> read_ded(const std::filesystem::path& path, CellCorner corner);

}  // namespace yars::model::terrain
