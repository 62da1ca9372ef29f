// Goes through the cells of a folder or a file of elevation, writes each below another folder, and says how it goes:
// a line for each cell, at the end what became of the size. Culture beside a cell goes with it. A cell or a file that
// cannot be read or written is a problem; the others go on, and the command fails in the end. The input is never
// written over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "lib/failure/error.hpp"
#include "model/terrain/cell_file.hpp"

namespace yars::tools {

struct TerrainBatch {
  std::string command;  // for messages
  std::string in;
  std::string out;
  int reduction = 0;  // at which cells are read
  // Below `out`, for a cell read from this file; the second function writes it there.
  std::function<std::string(model::terrain::CellPlace, const model::terrain::Cell&)> name;
  std::function<failure::Expected<std::filesystem::path>(const std::filesystem::path& tree,
                                                         const model::terrain::Cell&)>
      write;
  // Posts along a meridian of a cell as written: culture is thinned to no fewer. Null: it stays as it is.
  std::function<int(const model::terrain::Cell&)> culture_posts = {};
};

// Throws CommandFailed.
void run_terrain_batch(const TerrainBatch& batch);

}  // namespace yars::tools
