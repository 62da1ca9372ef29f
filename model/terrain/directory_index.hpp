// Which elevation file serves which one-degree cell, found in one walk of a directory tree by names (cell_file.hpp);
// only headers of .ded files, packs and rasters are opened, and the tail of packed HGT. Links to directories below
// the root are not followed. Where several files serve a cell, one that spans all of it (99 %) wins, then the finest
// spacing, then the format in the order of CellFormat, then the path in order; cells are not merged.
// Errors: the directory is missing or holds no cell. A file that looks like one and cannot be used is a problem.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lib/failure/error.hpp"
#include "model/terrain/cell_file.hpp"

namespace yars::model::terrain {

// Files by slot_of(place): in order, so that whatever goes through them is deterministic.
using DirectoryIndex = std::map<std::size_t, CellFile>;

// `problems` gets a sentence for each file that looks like cells and cannot be used, in order of the sentences.
failure::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory,
                                                  std::vector<std::string>* problems = nullptr);

// The cells of a single file; one of an unknown name is taken for a raster. Errors: it holds none that can be used.
failure::Expected<DirectoryIndex> index_file(const std::filesystem::path& path);

}  // namespace yars::model::terrain
