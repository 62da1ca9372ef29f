// Reads MultiGen's post-processed elevation files (`.ded`, big-endian): a header, statistics, a table of cells, then
// the posts of each cell, column by column, metres in two's complement. -32767 and -32768 count as void.
// A file holds several cells; each must be one degree on whole degrees (project choice: no resampling, which would
// move heights by up to half a post and open cracks to the neighbours).
// Errors: another magic, counts or spacings that do not fit a degree, a length that is not that of its cells.
// Layout: docs/spec/formats.md#ded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain {

struct DedCell {
  CellPlace place;
  int rows = 0;
  int columns = 0;
  std::uint64_t offset = 0;  // [bytes] of its first post in the file
  std::size_t bytes() const { return 2 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
};

// The cells of a file; reads its headers only.
error::Expected<std::vector<DedCell>> ded_cells(const std::filesystem::path& path);

error::Expected<CellReading> read_ded(const std::filesystem::path& path, CellPlace place);

// The same from memory; `subject` names the file in errors.
error::Expected<std::vector<DedCell>> parse_ded_cells(std::span<const std::byte> file, const std::string& subject);
error::Expected<CellReading> parse_ded(std::span<const std::byte> file, const std::string& subject, CellPlace place);

}  // namespace yars::model::terrain
