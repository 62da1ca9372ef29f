// Result of reading a cell from an elevation file, with its warnings; helpers that all readers share.
// Inputs: a file, or bytes of it. Outputs: a CellReading, raw bytes, warnings as sentences.
// Units: posts in the cell's unit above mean sea level; lengths and offsets in bytes.
// Errors: the file is missing, not a plain file, too long or too short; each error names the file.
// Threads: functions may run on any thread; a ReadingNotes or AllReadingNotes object belongs to one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::terrain {

// A cell as read, with the peculiarities of its file that do not prevent its use.
struct CellReading {
  Cell cell;                          // the grid that was achieved: (rows - 1) x (columns - 1) posts per degree
  std::optional<Cell> peaks;          // of a reduced reading, on the same grid; see cell.hpp
  std::vector<std::string> warnings;  // about this cell, one sentence each, without the file's name
  std::vector<std::string> file_warnings = {};  // rasters only: about the whole file, which serves many cells
  std::size_t impossible = 0;                   // rasters only: posts with impossible heights, made void
  bool damaged = false;                         // a checksum in the file is wrong
};

// Replaces impossible heights by voids and adds one warning with their number. Impossible are posts below -12,000 m,
// above 10,000 m, and -9999 m, which some producers write for no data. Posts are in metres.
void void_impossible_heights(std::vector<std::int16_t>& posts, std::vector<std::string>& warnings);

// The warning about `posts` impossible heights.
std::string impossible_heights_warning(std::size_t posts);

// The whole file. Errors: it cannot be opened or is larger than `limit_bytes`.
error::Expected<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::size_t limit_bytes);

// `bytes` bytes of a file from `offset` on. Errors: the file cannot be opened or ends earlier.
error::Expected<std::vector<std::byte>> read_file_part(const std::filesystem::path& path, std::uintmax_t offset,
                                                       std::size_t bytes);

// [bytes] of a plain file. Errors: it is missing or is no plain file.
error::Expected<std::uintmax_t> file_length(const std::filesystem::path& path);

// Turns the warnings of successive readings into sentences with the file's name. A warning about a whole raster is
// given once, however many of its cells are read. For stores, which report while they read.
class ReadingNotes {
 public:
  // The new sentences of this reading. Impossible heights of a raster are reported once, with the number of the first
  // cell that has any.
  std::vector<std::string> heard(const std::filesystem::path& path, const CellReading& reading);

 private:
  std::set<std::string> reported_;
};

// Collects warnings and problems until all cells are read. Impossible heights are summed over each raster.
// For commands that report at the end.
class AllReadingNotes {
 public:
  void add(const std::filesystem::path& path, const CellReading& reading);
  void add_file(const std::filesystem::path& path, const std::vector<std::string>& warnings, std::size_t impossible);
  void add_problem(std::string problem) { sentences_.push_back(std::move(problem)); }
  std::vector<std::string> sentences() const;

 private:
  std::set<std::string> reported_;
  std::vector<std::string> sentences_;
  std::map<std::string, std::size_t> impossible_;  // posts, by path
};

}  // namespace yars::model::terrain
