// Result of reading a cell from an elevation file, with the file access and warning texts that all readers share.
// Inputs: the path of an elevation file.
// Outputs: a CellReading (cell and warnings), file contents as bytes, warnings as sentences.
// Units: posts in the cell's unit above mean sea level; lengths and offsets in bytes.
// Errors: the file is missing, not a regular file, too long or too short. Each error names the file.
// Threads: the functions are thread-safe. A ReadingNotes or AllReadingNotes object belongs to one thread.
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

// A cell with what is to be said about it. A warning says that data of the file are left out or may be damaged. A note
// says how the data are taken, such as the accuracy of a change of datum.
struct CellReading {
  Cell cell;
  std::optional<Cell> peaks;                 // ReducedCell::peaks if the reader has reduced the cell
  std::vector<std::string> warnings;         // about data of this cell that are left out, without the file's name
  std::vector<std::string> notes = {};       // about this cell; nothing is left out
  std::vector<std::string> file_notes = {};  // rasters only: accuracy of the whole file, which contains many cells
  std::size_t impossible = 0;                // rasters only: posts with impossible heights, made void

  // Commands that report it end with exit code 1.
  bool has_problem() const { return !warnings.empty() || impossible > 0; }
};

// Replaces impossible heights by voids. If there are any, adds one warning with their number. Posts are in metres.
// Impossible: below -12,000 m, above 10,000 m, and -9999 m, which some producers write for missing data.
void void_impossible_heights(std::vector<std::int16_t>& posts, std::vector<std::string>& warnings);

inline constexpr double kLowLand_m = -10.0;  // [m MSL] land behind dikes is higher

// A note if posts beside the coast lie below the sea, as in files with the sea floor: such a file crosses the level of
// the sea at land beside negative posts, not at sea (0 m). At least 2 % of the posts have to be below kLowLand_m.
// nullopt for any other cell.
std::optional<std::string> sea_floor_note(const Cell& cell);

// Text of the warning about impossible heights; `posts`: their number.
std::string impossible_heights_warning(std::size_t posts);

// Memory that the readers of a thread use again for each cell. Fresh memory costs the operating system more time than
// decoding. The contents are those of the last cell, and callers overwrite them.
struct ReadingBuffers {
  std::vector<std::byte> file;
  std::vector<std::int16_t> posts;
  std::vector<std::uint8_t> codes;  // of a culture
};
ReadingBuffers& reading_buffers();  // of the calling thread

// Frees the memory of the calling thread's buffers.
void free_reading_buffers();

// Reads a whole file into `bytes`. Errors: the file cannot be opened or is larger than `limit_bytes`.
error::Expected<void> read_file(const std::filesystem::path& path, std::size_t limit_bytes,
                                std::vector<std::byte>& bytes);

// Reads a whole file. Errors: the file cannot be opened or is larger than `limit_bytes`.
error::Expected<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::size_t limit_bytes);

// Reads `bytes` bytes of a file from `offset` on. Errors: the file cannot be opened or ends earlier.
error::Expected<std::vector<std::byte>> read_file_part(const std::filesystem::path& path, std::uintmax_t offset,
                                                       std::size_t bytes);

// [bytes] Length of a file. Errors: the file is missing or is not a regular file.
error::Expected<std::uintmax_t> file_length(const std::filesystem::path& path);

// Sentences that begin with the name of a file.
struct FileSentences {
  std::vector<std::string> problems;  // data are left out or may be damaged
  std::vector<std::string> notes;     // how data are taken
};

// Turns the warnings and notes of successive readings into sentences. A store reports them while it loads cells. A note
// about a whole raster is reported once, however many of its cells are read.
class ReadingNotes {
 public:
  // Returns what is to be said about this cell, and about its whole file if no earlier call returned it.
  // Impossible heights of a raster are reported once, with their number in the first cell read that has any.
  FileSentences take_new(const std::filesystem::path& path, const CellReading& reading);

 private:
  std::set<std::string> reported_;
};

// Collects warnings, notes and problems until all cells are read, for commands that report at the end.
// Impossible heights are summed over all cells of a raster.
class AllReadingNotes {
 public:
  void add(const std::filesystem::path& path, const CellReading& reading);
  void add(FileSentences sentences);
  void add_file(const std::filesystem::path& path, const std::vector<std::string>& notes, std::size_t impossible);
  void add_problem(std::string problem) { problems_.push_back(std::move(problem)); }
  std::vector<std::string> problems() const;
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::set<std::string> reported_;
  std::vector<std::string> problems_, notes_;
  std::map<std::string, std::size_t> impossible_;  // number of impossible posts, by path
};

}  // namespace yars::model::terrain
