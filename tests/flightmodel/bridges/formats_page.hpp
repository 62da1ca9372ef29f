// Tables of docs/spec/formats.md#flight-models as data, and packets built by offsets, types and units of these tables.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/geo/quantity.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::flightmodel::bridges {

using TableRow = std::vector<std::string>;

inline std::string trimmed_cell(const std::string& cell) {
  const std::size_t first = cell.find_first_not_of(" `");
  return first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" `") + 1 - first);
}

// Rows below the head `first_column | ...` of the tables between an anchor and the next one.
inline std::vector<TableRow> table_of_formats(const std::string& anchor, const std::string& first_column) {
  std::ifstream page(YARS_SOURCE_DIR "/docs/spec/formats.md");
  std::vector<TableRow> rows;
  bool in_chapter = false, in_table = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("<a id=")) in_chapter = line.starts_with("<a id=\"" + anchor + "\">");
    if (!in_chapter || !line.starts_with("|")) {
      in_table = false;
      continue;
    }
    TableRow row;
    for (std::size_t begin = 1, end = 0; (end = line.find('|', begin)) != std::string::npos; begin = end + 1)
      row.push_back(trimmed_cell(line.substr(begin, end - begin)));
    if (in_table && !row[0].starts_with("---")) rows.push_back(row);
    if (row[0] == first_column) in_table = true;
  }
  return rows;
}

// A packet that is built by a table of offset, type, unit, field, read. All other bytes are 0xA5.
class PacketByPage {
 public:
  PacketByPage(const std::string& anchor, std::size_t bytes, std::endian order)
      : bytes_(bytes, std::byte{0xA5}), order_(order) {
    for (const TableRow& row : table_of_formats(anchor, "offset"))
      if (row.at(4) == "yes") rows_[trimmed_cell(row[3].substr(0, row[3].find_first_of(",:;(")))] = row;
  }

  // `name`: the field up to the first sign of punctuation. `value`: degrees, metres and seconds, or a plain number.
  void set(const std::string& name, double value) {
    const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const auto& entry) {
      return !set_.contains(entry.first) && (entry.first == name || entry.first.starts_with(name + " "));
    });
    if (found == rows_.end()) throw std::runtime_error("the page has no row for " + name);
    set_[found->first] = true;
    const TableRow& row = found->second;
    write(static_cast<std::size_t>(std::stoul(row[0])), row[1], value / unit_of(row[2]));
  }

  // True: each row that is read has been set.
  bool is_complete() const { return set_.size() == rows_.size(); }
  const PacketBytes& bytes() const { return bytes_; }

 private:
  static double unit_of(const std::string& unit) {
    static const std::map<std::string, double> kUnits{{"–", 1.0},
                                                      {"bytes", 1.0},
                                                      {"m", 1.0},
                                                      {"m/s", 1.0},
                                                      {"m/s²", 1.0},
                                                      {"rad", 1.0 / geo::kRadiansPerDegree},
                                                      {"rad/s", 1.0 / geo::kRadiansPerDegree},
                                                      {"ft/s", geo::kMetresPerFoot},
                                                      {"3600 s / 2³²", 3600.0 / 4294967296.0}};
    return kUnits.at(unit);
  }
  void write(std::size_t offset, const std::string& type, double value) {
    if (type == "f64") return put(bytes_, offset, value, order_);
    if (type == "f32") return put(bytes_, offset, static_cast<float>(value), order_);
    if (type == "u32") return put(bytes_, offset, static_cast<std::uint32_t>(value), order_);
    if (type == "u16") return put(bytes_, offset, static_cast<std::uint16_t>(value), order_);
    if (type == "u8") return put(bytes_, offset, static_cast<std::uint8_t>(value), order_);
    throw std::runtime_error("the page has a type " + type);
  }

  PacketBytes bytes_;
  std::endian order_;
  std::map<std::string, TableRow> rows_;
  std::map<std::string, bool> set_;
};

}  // namespace yars::flightmodel::bridges
