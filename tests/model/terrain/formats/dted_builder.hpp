// Builds DTED files byte by byte, independently of YARS's writer: 5 x 5 posts, 900 arc seconds apart. This is the
// smallest grid whose interval in tenths of an arc second has four digits. Tests can set each field to a wrong value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace yars::test {

inline constexpr int kSmallSide = 5;

struct DtedColumn {
  int longitude_index = 0;
  int latitude_index = 0;
  std::vector<std::uint16_t> words;  // posts as encoded in the file
  int sum_error = 0;                 // added to the checksum
  std::uint8_t sentinel = 0xAA;
};

struct DtedFile {
  std::string labels;  // tape labels before the header UHL
  std::string magic = "UHL1";
  std::string longitude = "0100000E";
  std::string latitude = "0500000N";
  std::string longitude_interval = "9000";
  std::string latitude_interval = "9000";
  std::string longitude_count = "0005";
  std::string latitude_count = "0005";
  std::string vertical_datum = "MSL";
  std::string horizontal_datum = "WGS84";
  std::vector<DtedColumn> columns;

  std::vector<std::byte> bytes() const {
    std::string header = magic + longitude + latitude + longitude_interval + latitude_interval;
    header.resize(47, ' ');
    header += longitude_count + latitude_count;
    header.resize(80 + 141, ' ');
    header += vertical_datum + horizontal_datum;
    header.resize(3428, ' ');
    std::vector<std::byte> file;
    for (const char letter : labels + header) file.push_back(static_cast<std::byte>(letter));
    for (const DtedColumn& column : columns) append(column, file);
    return file;
  }

 private:
  static void append(const DtedColumn& column, std::vector<std::byte>& file) {
    const std::size_t start = file.size();
    const auto byte = [&](unsigned value) { file.push_back(static_cast<std::byte>(value & 0xFFU)); };
    const auto word = [&](unsigned value) {
      byte(value >> 8U);
      byte(value);
    };
    byte(column.sentinel);
    byte(0);
    word(static_cast<unsigned>(column.longitude_index));
    word(static_cast<unsigned>(column.longitude_index));
    word(static_cast<unsigned>(column.latitude_index));
    for (const std::uint16_t value : column.words) word(value);
    unsigned sum = 0;
    for (std::size_t at = start; at < file.size(); ++at) sum += std::to_integer<unsigned>(file[at]);
    sum += static_cast<unsigned>(column.sum_error);
    word(sum >> 16U);
    word(sum);
  }
};

// Five complete columns. Post (row, column) is 100 * column + row.
inline DtedFile small_dted() {
  DtedFile file;
  for (int column = 0; column < kSmallSide; ++column) {
    DtedColumn record{.longitude_index = column, .words = {}};
    for (int row = 0; row < kSmallSide; ++row) record.words.push_back(static_cast<std::uint16_t>(100 * column + row));
    file.columns.push_back(record);
  }
  return file;
}

// The same grid at another south-west corner. All posts are `height`.
inline DtedFile level_dted(int south_deg, int west_deg, std::uint16_t height) {
  DtedFile file = small_dted();
  char text[16];
  std::snprintf(text, sizeof text, "%03d0000%c", std::abs(west_deg), west_deg < 0 ? 'W' : 'E');
  file.longitude = text;
  std::snprintf(text, sizeof text, "%03d0000%c", std::abs(south_deg), south_deg < 0 ? 'S' : 'N');
  file.latitude = text;
  for (DtedColumn& column : file.columns) column.words.assign(kSmallSide, height);
  return file;
}

// New folder in the system's temporary folder. The destructor removes it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "yars-terrain-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    path_ = pattern;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::vector<std::byte>& bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace yars::test
