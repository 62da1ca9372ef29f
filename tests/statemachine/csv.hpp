// Reader of hand-written test tables: comment lines (#), a line of column names, then rows. A cell contains no comma.
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace yars::statemachine::testing {

inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

using Row = std::map<std::string, std::string>;

// Reads a file of tests/statemachine. The rows map column names to cells.
inline std::vector<Row> read_csv(const std::string& name) {
  std::ifstream file(std::string(YARS_SOURCE_DIR) + "/tests/statemachine/" + name);
  if (!file) throw std::runtime_error("cannot open " + name);
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto cells = split(line, ',');
    if (names.empty()) {
      names = cells;
      continue;
    }
    if (cells.size() != names.size()) throw std::runtime_error(name + ": wrong number of cells in " + line);
    Row& row = rows.emplace_back();
    for (std::size_t cell = 0; cell < names.size(); ++cell) row[names[cell]] = cells[cell];
  }
  return rows;
}

}  // namespace yars::statemachine::testing
