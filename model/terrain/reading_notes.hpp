// What is odd about elevation files, in sentences with the file's name, as their cells are read: of a cell at once, of
// a raster once for the file however many cells it serves.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/terrain/cell_reading.hpp"

namespace yars::model::terrain {

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
