// Reader of MultiGen's post-processed elevation files (`.ded`). A file holds several cells.
// Input: a file, or its bytes. Output: the table of cells; one cell as a CellReading.
// Units: metres; -32767 and -32768 are void.
// Errors: another magic, counts or spacings that do not fit one degree, cells not on whole degrees, a wrong length.
//   Cells are not resampled (project choice): that would move heights by up to half a post and open cracks.
// Source: docs/spec/formats.md#ded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain {

// One row of the table of cells.
struct DedCell {
  CellCorner corner;
  int rows = 0;
  int columns = 0;
  std::uint64_t offset = 0;  // [bytes] of its first post in the file
  std::size_t bytes() const { return 2 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
};

// The table of cells. Reads the headers only.
error::Expected<std::vector<DedCell>> ded_cells(const std::filesystem::path& path);

// One cell of a file. Errors: those of ded_cells(), or the file has no cell at `place`.
error::Expected<CellReading> read_ded(const std::filesystem::path& path, CellCorner corner);

// The same from memory; `subject` names the file in errors.
error::Expected<std::vector<DedCell>> parse_ded_cells(std::span<const std::byte> file, const std::string& subject);
error::Expected<CellReading> parse_ded(std::span<const std::byte> file, const std::string& subject, CellCorner corner);

}  // namespace yars::model::terrain
