// Which elevation file serves which one-degree cell, found by names alone in one walk of a directory tree:
// `wLLL/nBB.dtN` (N 0 to 2), `N36W122.hgt`, packed HGT too (refused by the reader with a word). Case does not
// matter; links to directories below the root are not followed. Where several files serve a cell the finest
// spacing wins, then DTED before HGT, then a plain file before a packed one, then the path in order.
// Errors: the directory is missing or holds no cell.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "lib/failure/error.hpp"
#include "model/terrain/cell_reading.hpp"

namespace yars::model::terrain {

enum class CellFormat : std::uint8_t { dted, hgt, packed_hgt };

struct CellFile {
  std::filesystem::path path;
  CellFormat format = CellFormat::dted;
  int posts_per_degree = 0;  // along a meridian; 0 = not known from name and length
};

// Files by slot_of(place): in order, so that whatever goes through them is deterministic.
using DirectoryIndex = std::map<std::size_t, CellFile>;

failure::Expected<DirectoryIndex> index_directory(const std::filesystem::path& directory);

// The place that a file of this name in this folder serves; nothing when it is no cell's name.
struct NamedCell {
  CellPlace place;
  CellFormat format = CellFormat::dted;
  int level = -1;  // DTED level; -1 for HGT
};
std::optional<NamedCell> cell_named(const std::string& folder, const std::string& file);

// Reads the file of a cell by the reader of its format.
failure::Expected<CellReading> read_cell(const CellFile& file, CellPlace place);

}  // namespace yars::model::terrain
