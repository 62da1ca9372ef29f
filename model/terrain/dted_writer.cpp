#include "model/terrain/dted_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "lib/failure/require.hpp"
#include "lib/file/new_file.hpp"
#include "model/terrain/dted_format.hpp"

namespace yars::model::terrain {

namespace {

// Fixed-width text fields at their offsets; the rest of a header is blanks.
class HeaderText {
 public:
  explicit HeaderText(std::size_t bytes) : text_(bytes, ' ') {}
  void put(std::size_t offset, std::string_view field) {
    std::copy(field.begin(), field.end(), text_.begin() + static_cast<std::ptrdiff_t>(offset));
  }
  void append_to(std::vector<std::byte>& bytes) const {
    for (const char letter : text_) bytes.push_back(static_cast<std::byte>(letter));
  }

 private:
  std::string text_;
};

std::string padded(int value, int digits) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%0*d", digits, value);
  return text.data();
}

std::string longitude_field(int degrees) {
  return padded(std::abs(degrees), 3) + "0000" + (degrees < 0 ? "W" : "E");
}
std::string latitude_field(int degrees) {
  return padded(std::abs(degrees), 3) + "0000" + (degrees < 0 ? "S" : "N");
}

void append_header(const Cell& cell, int level, std::vector<std::byte>& bytes) {
  const std::string longitude_interval = padded(dted::kTenthsPerDegree / (cell.columns() - 1), 4);
  const std::string latitude_interval = padded(dted::kTenthsPerDegree / (cell.rows() - 1), 4);
  HeaderText user(dted::kUserHeaderBytes);
  user.put(0, "UHL1");
  user.put(4, longitude_field(cell.place().west_deg));
  user.put(12, latitude_field(cell.place().south_deg));
  user.put(20, longitude_interval);
  user.put(24, latitude_interval);
  user.put(28, "NA  U");  // vertical accuracy not known; unclassified
  user.put(47, padded(cell.columns(), 4));
  user.put(51, padded(cell.rows(), 4));
  user.put(55, "0");  // one accuracy for the cell
  user.append_to(bytes);
  HeaderText description(dted::kDescriptionBytes);
  description.put(0, "DSIU");
  description.put(59, "DTED" + std::to_string(level));
  description.put(141, "MSLWGS84");  // vertical and horizontal datum
  description.put(273, latitude_interval);
  description.put(277, longitude_interval);
  description.put(281, padded(cell.rows(), 4));
  description.put(285, padded(cell.columns(), 4));
  description.put(289, "00");  // complete
  description.append_to(bytes);
  HeaderText accuracy(dted::kAccuracyBytes);
  accuracy.put(0, "ACCNA  NA  NA  NA  ");
  accuracy.put(55, "00");
  accuracy.append_to(bytes);
}

void append_16(std::uint32_t word, std::vector<std::byte>& bytes) {
  bytes.push_back(static_cast<std::byte>(word >> 8U & 0xFFU));
  bytes.push_back(static_cast<std::byte>(word & 0xFFU));
}

std::uint32_t sign_magnitude_word(std::int16_t post_m) {
  if (post_m == kVoidPost) return dted::kVoidWord;
  return post_m < 0 ? 0x8000U | static_cast<std::uint32_t>(-post_m) : static_cast<std::uint32_t>(post_m);
}

void append_column(const Cell& cell, int column, std::vector<std::byte>& bytes) {
  const std::size_t start = bytes.size();
  append_16(static_cast<std::uint32_t>(dted::kRecordSentinel) << 8U, bytes);  // sentinel and the count's high byte
  append_16(static_cast<std::uint32_t>(column), bytes);                       // count
  append_16(static_cast<std::uint32_t>(column), bytes);                       // longitude index
  append_16(0, bytes);                                                        // latitude index
  for (int row = 0; row < cell.rows(); ++row) append_16(sign_magnitude_word(cell.post(row, column)), bytes);
  std::uint32_t sum = 0;
  for (std::size_t at = start; at < bytes.size(); ++at) sum += std::to_integer<std::uint32_t>(bytes[at]);
  append_16(sum >> 16U, bytes);
  append_16(sum & 0xFFFFU, bytes);
}

}  // namespace

std::string dted_name(CellPlace place, int level) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%c%03d/%c%02d.dt%d", place.west_deg < 0 ? 'w' : 'e',
                std::abs(place.west_deg), place.south_deg < 0 ? 's' : 'n', std::abs(place.south_deg), level);
  return name.data();
}

int dted_columns(CellPlace place, int level) {
  return (dted::kPostsOfLevel[level] - 1) / dted::zone_factor(place.south_deg) + 1;
}

std::vector<std::byte> dted_bytes(const Cell& cell, int level) {
  YARS_REQUIRE(cell.unit_m(), ==, 1.0);
  YARS_REQUIRE(cell.rows(), ==, dted::kPostsOfLevel[level]);
  std::vector<std::byte> bytes;
  bytes.reserve(dted::kHeaderBytes + static_cast<std::size_t>(cell.columns()) * dted::record_bytes(cell.rows()));
  append_header(cell, level, bytes);
  for (int column = 0; column < cell.columns(); ++column) append_column(cell, column, bytes);
  return bytes;
}

failure::Expected<std::filesystem::path> write_dted(const std::filesystem::path& tree, const Cell& cell, int level) {
  return file::write_file_and_folders(tree / dted_name(cell.place(), level), dted_bytes(cell, level));
}

}  // namespace yars::model::terrain
