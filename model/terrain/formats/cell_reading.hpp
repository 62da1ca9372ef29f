// Result of reading an elevation file, and the notes about it.
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

// What a reader of elevation files hands back: the cell, and what was odd about the file without spoiling it.
struct CellReading {
  Cell cell;                          // its grid is what was achieved: (rows - 1) x (columns - 1) posts per degree
  std::optional<Cell> peaks;          // of a reduced reading, on the same grid; see cell.hpp
  std::vector<std::string> warnings;  // one sentence each, without the file's name
  // Of a raster, which serves many cells: what is true of all of it, and posts that no ground has; see ReadingNotes.
  std::vector<std::string> file_warnings = {};
  std::size_t impossible = 0;
  bool damaged = false;  // the file itself shows it: a wrong checksum
};

// Heights that no ground on earth has (below -12,000 m, above 10,000 m; -9999, which some makers write for no data)
// become voids, with a warning that counts them.
void void_impossible_heights(std::vector<std::int16_t>& posts, std::vector<std::string>& warnings);

// The sentence that counts such posts.
std::string impossible_heights_warning(std::size_t posts);

// A whole file in memory. Fails on a file that cannot be opened or is larger than `limit_bytes`.
error::Expected<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::size_t limit_bytes);

// So many bytes of a file from `offset` on. Fails on a file that cannot be opened or ends before.
error::Expected<std::vector<std::byte>> read_file_part(const std::filesystem::path& path, std::uintmax_t offset,
                                                       std::size_t bytes);

// The length of a plain file.
error::Expected<std::uintmax_t> file_length(const std::filesystem::path& path);

// What is odd about elevation files, in sentences with the file's name, as their cells are read: of a cell at once, of
// a raster once for the file however many cells it serves.
class ReadingNotes {
 public:
  // What this reading brings that is new. Of posts that no ground has it counts those of a raster's first such cell.
  std::vector<std::string> heard(const std::filesystem::path& path, const CellReading& reading);

 private:
  std::set<std::string> said_;
};

// The same for those who read everything and say it in the end: such posts are counted over the whole raster.
class AllReadingNotes {
 public:
  void add(const std::filesystem::path& path, const CellReading& reading);
  void add_file(const std::filesystem::path& path, const std::vector<std::string>& warnings, std::size_t impossible);
  void add_problem(std::string problem) { sentences_.push_back(std::move(problem)); }
  std::vector<std::string> sentences() const;

 private:
  std::set<std::string> said_;
  std::vector<std::string> sentences_;
  std::map<std::string, std::size_t> impossible_;  // by file
};

}  // namespace yars::model::terrain
