// Builds MultiGen DED (terrain elevation) files byte by byte, independently of the reader. Tests can set each field to
// a wrong value.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace yars::test {

struct DedCellFields {
  float south = 0, north = 0, west = 0, east = 0;  // [deg]
  float spacing_north = 0, spacing_east = 0;       // [0.1 arc second]
  float posts_north = 0, posts_east = 0;
  std::vector<std::int16_t> posts;  // column by column, south to north
};

// Cell of one degree. Post (row, column) is 100 * column + row.
inline DedCellFields ded_cell(int south_deg, int west_deg, int rows, int columns) {
  DedCellFields cell{static_cast<float>(south_deg),
                     static_cast<float>(south_deg + 1),
                     static_cast<float>(west_deg),
                     static_cast<float>(west_deg + 1),
                     36000.0F / static_cast<float>(rows - 1),
                     36000.0F / static_cast<float>(columns - 1),
                     static_cast<float>(rows),
                     static_cast<float>(columns),
                     {}};
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row) cell.posts.push_back(static_cast<std::int16_t>(100 * column + row));
  return cell;
}

struct DedFile {
  std::uint32_t header_length = 128;
  std::string magic = "SSYS";
  std::string part = "DED1";
  std::int64_t cell_count = -1;  // -1: the number of `cells`
  std::vector<DedCellFields> cells;

  std::vector<std::byte> bytes() const {
    std::vector<std::byte> file;
    word(header_length, file);
    std::string text = magic + part + std::string(4, ' ') + "V1.0    ";
    text.resize(124, ' ');
    for (const char letter : text) file.push_back(static_cast<std::byte>(letter));
    word(static_cast<std::uint32_t>(cell_count < 0 ? static_cast<std::int64_t>(cells.size()) : cell_count), file);
    file.resize(160);
    for (const DedCellFields& cell : cells)
      for (const float value : {cell.south, cell.north, cell.west, cell.east, cell.spacing_north, cell.spacing_east,
                                cell.posts_north, cell.posts_east, 0.0F, 0.0F})
        word(std::bit_cast<std::uint32_t>(value), file);
    for (const DedCellFields& cell : cells)
      for (const std::int16_t post : cell.posts) {
        const auto value = static_cast<std::uint16_t>(post);
        file.push_back(static_cast<std::byte>(value >> 8U));
        file.push_back(static_cast<std::byte>(value & 0xFFU));
      }
    return file;
  }

 private:
  static void word(std::uint32_t value, std::vector<std::byte>& file) {
    for (const unsigned shift : {24U, 16U, 8U, 0U}) file.push_back(static_cast<std::byte>(value >> shift & 0xFFU));
  }
};

}  // namespace yars::test
