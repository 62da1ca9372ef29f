#include "model/terrain/hgt_writer.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>

#include "lib/failure/require.hpp"
#include "lib/file/new_file.hpp"
#include "model/terrain/hgt_reader.hpp"

namespace yars::model::terrain {

std::string hgt_name(CellPlace place) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%c%02d%c%03d.hgt", place.south_deg < 0 ? 'S' : 'N',
                std::abs(place.south_deg), place.west_deg < 0 ? 'W' : 'E', std::abs(place.west_deg));
  return name.data();
}

std::vector<std::byte> hgt_bytes(const Cell& cell) {
  const std::size_t size = 2 * static_cast<std::size_t>(cell.rows()) * static_cast<std::size_t>(cell.columns());
  YARS_REQUIRE(cell.unit_m(), ==, 1.0);
  YARS_REQUIRE(cell.rows(), ==, cell.columns());
  YARS_REQUIRE(hgt_posts_for_size(size), ==, cell.rows());
  static_assert(kVoidPost == -32768, "the void of HGT");
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  for (int row = cell.rows() - 1; row >= 0; --row)
    for (int column = 0; column < cell.columns(); ++column) {
      const auto word = static_cast<std::uint16_t>(cell.post(row, column));
      bytes.push_back(static_cast<std::byte>(word >> 8U));
      bytes.push_back(static_cast<std::byte>(word & 0xFFU));
    }
  return bytes;
}

failure::Expected<std::filesystem::path> write_hgt(const std::filesystem::path& tree, const Cell& cell) {
  return file::write_file_and_folders(tree / hgt_name(cell.place()), hgt_bytes(cell));
}

}  // namespace yars::model::terrain
