// Writers of elevation cells by the word of the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lib/failure/error.hpp"
#include "model/terrain/cell.hpp"

namespace yars::tools {

// "dted", "hgt" or "jp2", and the grid: DTED level 0, 1 or 2; none: the finest level that the cell fills, a pack as
// it is. HGT has the grids of levels 1 and 2 without thinned columns.
struct TerrainOutput {
  std::string format = "dted";
  std::optional<int> level;
};

std::string output_name(const TerrainOutput& output, model::terrain::CellPlace place, const model::terrain::Cell& cell);

// The cell on the output's grid (see resample.hpp), in its file below `tree`.
failure::Expected<std::filesystem::path> write_output(const TerrainOutput& output, const std::filesystem::path& tree,
                                                      const model::terrain::Cell& cell);

}  // namespace yars::tools
