#include "model/terrain/formats/dted.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"
#include "lib/memory/byte_order.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::model::terrain {

namespace {

using dted::kRecordHeadBytes;
using dted::kRecordSumBytes;

struct Header {
  CellCorner corner;
  int columns = 0;
  int rows = 0;
  std::size_t data_offset = 0;
};

// A record inside the cell: its column, and its heights from row `first_row` on, in big-endian words.
struct ColumnRecord {
  std::size_t column = 0;
  std::size_t first_row = 0;
  const std::byte* words = nullptr;
};

// The records of a file in its order, number of columns that have a record, and numbers of records with defects.
struct Columns {
  std::vector<ColumnRecord> records;
  std::size_t present = 0;
  std::size_t wrong_sums = 0;
  std::size_t partial = 0;
  std::size_t bytes_after = 0;  // after the last record of a complete cell
};

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::optional<int> number(std::string_view digits) {
  int value = 0;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') return std::nullopt;
    value = value * 10 + (digit - '0');
  }
  return value;
}

// Whole degrees of a field DDDMMSSH (H: hemisphere); nullopt for another form, or minutes or seconds other than 0.
std::optional<int> whole_degrees(std::string_view field) {
  const std::optional<int> degrees = number(field.substr(0, 3));
  const std::optional<int> rest = number(field.substr(3, 4));
  const char side = field[7];
  if (!degrees || !rest || *rest != 0) return std::nullopt;
  if (side == 'N' || side == 'E') return *degrees;
  if (side == 'S' || side == 'W') return -*degrees;
  return std::nullopt;
}

std::string name_of(CellCorner corner) {
  return "south-west corner " + std::to_string(corner.south_deg) + ", " + std::to_string(corner.west_deg);
}

// A field without blanks and null characters. Other unprintable characters become question marks.
std::string stripped(std::string_view field) {
  std::string text;
  for (const char letter : field)
    if (letter != ' ' && letter != '\0') text.push_back(letter > ' ' && letter <= '~' ? letter : '?');
  return text;
}

error::Expected<Header> parse_header(std::span<const std::byte> bytes, const std::string& subject) {
  std::size_t start = 0;
  // A file copied from a tape may begin with the tape's labels of volume (VOL) and file (HDR).
  while (bytes.size() >= start + dted::kLabelBytes) {
    const std::string_view label = text_of(bytes.subspan(start, 3));
    if (label != "VOL" && label != "HDR") break;
    start += dted::kLabelBytes;
  }
  if (bytes.size() < start + dted::kHeaderBytes)
    return error::fail(subject, "a DTED header of " + text::counted(dted::kHeaderBytes, "byte"),
                       text::counted(bytes.size() - start, "byte"), "the file is truncated; fetch it again");
  const std::string_view user_header = text_of(bytes.subspan(start, dted::kUserHeaderBytes));
  if (user_header.substr(0, 4) != "UHL1")
    return error::fail(subject, "a DTED file that begins with UHL1", "other bytes");
  const std::string_view description = text_of(bytes.subspan(start + dted::kUserHeaderBytes, dted::kDescriptionBytes));
  if (const auto checked =
          check_dted_datums(description.substr(dted::kVerticalDatumAt, dted::kVerticalDatumBytes),
                            description.substr(dted::kHorizontalDatumAt, dted::kHorizontalDatumBytes), subject);
      !checked)
    return tl::unexpected(checked.error());
  const std::optional<int> west_deg = whole_degrees(user_header.substr(4, 8));
  const std::optional<int> south_deg = whole_degrees(user_header.substr(12, 8));
  const std::optional<int> interval = number(user_header.substr(20, 4));
  const std::optional<int> latitude_interval = number(user_header.substr(24, 4));
  const std::optional<int> columns = number(user_header.substr(47, 4));
  const std::optional<int> rows = number(user_header.substr(51, 4));
  if (!west_deg || !south_deg || !interval || !latitude_interval || !columns || !rows)
    return error::fail(subject, "UHL fields in digits, origin in whole degrees",
                       std::string(user_header.substr(0, 55)));
  const int max_posts = dted::kPostsOfLevel[2];
  if (*columns < 2 || *rows < 2 || *columns > max_posts || *rows > max_posts ||
      (*columns - 1) * *interval != dted::kTenthsPerDegree ||
      (*rows - 1) * *latitude_interval != dted::kTenthsPerDegree)
    return error::fail(subject, "posts that span one degree, 2 to 3601 a side",
                       std::to_string(*columns) + " x " + std::to_string(*rows) + " posts at " +
                           std::to_string(*interval) + " x " + std::to_string(*latitude_interval) +
                           " tenths of a second");
  if (*south_deg < -90 || *south_deg > 89 || *west_deg < -180 || *west_deg > 179)
    return error::fail(subject, "a cell on the earth", name_of({*south_deg, *west_deg}) + " in its header");
  return Header{{*south_deg, *west_deg}, *columns, *rows, start + dted::kHeaderBytes};
}

bool sum_matches(std::span<const std::byte> record) {
  std::uint32_t sum = 0;
  const std::size_t body = record.size() - kRecordSumBytes;
  for (const std::byte byte : record.first(body)) sum += std::to_integer<std::uint32_t>(byte);
  return sum == memory::big_endian<std::uint32_t>(record.data() + body);
}

// The record at the front of `rest`; nullopt if it is truncated. If a column begins north of the south edge, its record
// has full length in some files and is shorter in others. The length that fits the checksum is used. If neither fits,
// full length is used.
std::optional<std::span<const std::byte>> next_record(std::span<const std::byte> rest, int rows, int first_row) {
  const std::size_t full = dted::record_bytes(rows);
  const std::size_t partial = dted::record_bytes(rows - first_row);
  if (rest.size() >= full && (first_row == 0 || sum_matches(rest.first(full)))) return rest.first(full);
  if (first_row > 0 && rest.size() >= partial && sum_matches(rest.first(partial))) return rest.first(partial);
  if (rest.size() >= full) return rest.first(full);
  return std::nullopt;
}

// Without branches, so that the compiler uses SIMD.
std::int16_t sign_magnitude(std::int16_t word) {
  const int sign = word >> 15;  // 0 or -1
  return static_cast<std::int16_t>(((word & 0x7FFF) ^ sign) - sign);
}

error::Expected<Columns> find_columns(std::span<const std::byte> data, const Header& header,
                                      const std::string& subject) {
  Columns found;
  std::vector<bool> seen(static_cast<std::size_t>(header.columns));
  for (std::span<const std::byte> rest = data; !rest.empty();) {
    const auto at = [&] { return "column record " + std::to_string(found.present + 1); };
    const auto truncated = [&] {
      const bool complete = found.present == seen.size();
      return error::fail(subject, complete ? "nothing after the last column record" : "a whole " + at(),
                         text::counted(rest.size(), "byte"), "the file is truncated or damaged; fetch it again");
    };
    // Padding, or what else a transfer added. A further record of a column replaces that column.
    if (found.present == seen.size() && std::to_integer<std::uint8_t>(rest[0]) != dted::kRecordSentinel) {
      found.bytes_after = rest.size();
      break;
    }
    if (rest.size() < kRecordHeadBytes) return truncated();
    const std::size_t column = memory::big_endian<std::uint16_t>(rest.data() + 4);
    const int first_row = memory::big_endian<std::uint16_t>(rest.data() + 6);
    if (std::to_integer<std::uint8_t>(rest[0]) != dted::kRecordSentinel || column >= seen.size() ||
        first_row >= header.rows)
      return error::fail(subject, at() + " that begins with AA and lies inside the cell",
                         "longitude index " + std::to_string(column) + ", latitude index " + std::to_string(first_row));
    const auto record = next_record(rest, header.rows, first_row);
    if (!record) return truncated();
    found.records.push_back({column, static_cast<std::size_t>(first_row), record->data() + kRecordHeadBytes});
    if (!sum_matches(*record)) ++found.wrong_sums;
    if (first_row > 0) ++found.partial;
    if (!seen[column]) ++found.present;
    seen[column] = true;
    rest = rest.subspan(record->size());
  }
  return found;
}

// Copies the heights of records side by side, which begin at the same row, to `words`, row by row.
void copy_tile(std::span<const ColumnRecord> records, const Header& header, std::vector<std::int16_t>& words) {
  const auto rows = static_cast<std::size_t>(header.rows), columns = static_cast<std::size_t>(header.columns);
  const ColumnRecord& first = records.front();
  for (std::size_t row = first.first_row; row < rows; ++row) {
    const std::byte* from = first.words + 2 * (row - first.first_row);
    std::int16_t* to = &words[row * columns + first.column];
    for (std::size_t i = 0; i < records.size(); ++i, from += dted::record_bytes(header.rows))
      to[i] = memory::big_endian<std::int16_t>(from);
  }
}

// Copies the heights of all records to `words`, row by row. Posts without a record keep their value in `words`.
// If two records have the same column, the heights of the later one are used.
void copy_words(std::span<const ColumnRecord> records, const Header& header, std::vector<std::int16_t>& words) {
  constexpr std::size_t kTile = 32;  // [columns] 64 bytes of a row of `words`, one cache line
  const auto follows = [&](const ColumnRecord& one, const ColumnRecord& next) {
    return one.first_row == 0 && next.first_row == 0 && next.column == one.column + 1 &&
           next.words == one.words + dted::record_bytes(header.rows);
  };
  while (!records.empty()) {
    std::size_t count = 1;
    while (count < std::min(kTile, records.size()) && follows(records[count - 1], records[count])) ++count;
    copy_tile(records.first(count), header, words);
    records = records.subspan(count);
  }
}

// True if some word is too low a height in sign-magnitude. All words are then taken to be in two's complement.
bool is_twos_complement(const std::vector<std::int16_t>& words) {
  // Depth [m] below the deepest sea floor, so that real depths in sign-magnitude stay valid; docs/spec/formats.md#dted
  constexpr int kDeepestSignMagnitude_m = 16000;
  std::int16_t highest = INT16_MIN;
  for (const std::int16_t word : words) {
    // Plus 1, a void wraps to 0. The change of the highest bit keeps the order of unsigned words in signed ones.
    const unsigned next = (static_cast<std::uint16_t>(word) + 1U) ^ 0x8000U;
    highest = std::max(highest, static_cast<std::int16_t>(next));
  }
  return highest > kDeepestSignMagnitude_m + 1;
}

// Replaces words by posts.
void decode(std::vector<std::int16_t>& words, bool twos_complement) {
  constexpr auto kVoidWord = static_cast<std::int16_t>(dted::kVoidWord);
  for (std::int16_t& word : words) {
    const std::int16_t height_m = twos_complement ? std::max(word, std::int16_t{-32767}) : sign_magnitude(word);
    word = word == kVoidWord || height_m == -32767 ? kVoidPost : height_m;
  }
}

// Adds what is to be said about the columns. Columns shorter than the cell are those of a cell at a border, and bytes
// after the last one are padding: nothing of the file is left out.
void add_sentences(const Columns& found, const Header& header, CellReading& reading) {
  const auto add = [](std::vector<std::string>& to, const char* what, std::size_t number, const char* consequence) {
    if (number > 0) to.push_back(what + std::to_string(number) + consequence);
  };
  add(reading.warnings, "columns with a wrong checksum: ", found.wrong_sums, "; their heights are kept");
  add(reading.warnings, "absent columns: ", static_cast<std::size_t>(header.columns) - found.present,
      "; they are void");
  add(reading.notes, "partial columns: ", found.partial, "; their missing posts are void");
  add(reading.notes, "bytes after the last column record: ", found.bytes_after, "; they are ignored");
}

}  // namespace

// Longitudes in WGS72 differ by 0.554 arc seconds (17 m at the equator) from those in WGS84. The reader refuses WGS72
// and does not shift its posts, because interpolation would smooth the heights. The error message advises gdalwarp.
error::Expected<void> check_dted_datums(std::string_view vertical_field, std::string_view horizontal_field,
                                        const std::string& subject) {
  constexpr std::string_view kSeaLevels[] = {"", "MSL", "E84", "E96", "E08"};
  const std::string vertical = stripped(vertical_field);
  const std::string horizontal = stripped(horizontal_field);
  if (!horizontal.empty() && horizontal != "WGS84")
    return error::fail(
        subject, "horizontal datum WGS84", "'" + horizontal + "'",
        "convert it to WGS84 with gdalwarp -s_srs DATUM -t_srs EPSG:4326 into a .tif; DATUM is EPSG:4322 "
        "for WGS72, EPSG:4267 for NAD27");
  if (std::find(std::begin(kSeaLevels), std::end(kSeaLevels), vertical) == std::end(kSeaLevels))
    return error::fail(subject, "heights above mean sea level (vertical datum MSL, E84, E96, E08 or none)",
                       "'" + vertical + "'", "convert the heights to mean sea level");
  return {};
}

error::Expected<CellReading> parse_dted(std::span<const std::byte> bytes, const std::string& subject,
                                        CellCorner corner) {
  const error::Expected<Header> header = parse_header(bytes, subject);
  if (!header) return tl::unexpected(header.error());
  if (!(header->corner == corner))
    return error::fail(subject, name_of(corner) + " as the name says", name_of(header->corner) + " in its header",
                       "rename or replace the file");
  const std::span<const std::byte> data = bytes.subspan(header->data_offset);
  if (data.empty())
    return error::fail(subject, std::to_string(header->columns) + " columns of posts", "a header alone",
                       "the file is truncated; fetch it again");
  const error::Expected<Columns> columns = find_columns(data, *header, subject);
  if (!columns) return tl::unexpected(columns.error());
  std::vector<std::int16_t>& posts = reading_buffers().posts;
  posts.assign(static_cast<std::size_t>(header->rows) * static_cast<std::size_t>(header->columns),
               static_cast<std::int16_t>(dted::kVoidWord));
  copy_words(columns->records, *header, posts);
  const bool twos_complement = is_twos_complement(posts);
  std::vector<std::string> impossible;
  decode(posts, twos_complement);
  void_impossible_heights(posts, impossible);
  CellReading reading{Cell(corner, header->rows, header->columns, posts), std::nullopt, {}};
  add_sentences(*columns, *header, reading);
  std::move(impossible.begin(), impossible.end(), std::back_inserter(reading.warnings));
  if (twos_complement) reading.notes.emplace_back("negative heights are in two's complement, not in sign-magnitude");
  return reading;
}

namespace {
constexpr std::size_t kMaxLabel_bytes = 8 * dted::kLabelBytes;
}  // namespace

error::Expected<DtedPlace> dted_place(const std::filesystem::path& path) {
  const auto length = file_length(path);
  if (!length) return tl::unexpected(length.error());
  const auto head = read_file_part(path, 0, std::min<std::uintmax_t>(*length, kMaxLabel_bytes + dted::kHeaderBytes));
  if (!head) return tl::unexpected(head.error());
  const auto header = parse_header(*head, path.string());
  if (!header) return tl::unexpected(header.error());
  return DtedPlace{header->corner, {header->rows, header->columns}};
}

bool begins_as_dted(const std::filesystem::path& path) {
  const auto head = read_file_part(path, 0, 4);
  if (!head) return false;
  const std::string_view label = text_of(*head);
  return label == "UHL1" || label == "VOL1" || label == "HDR1";
}

error::Expected<CellReading> read_dted(const std::filesystem::path& path, CellCorner corner) {
  // The size of a level 2 file that begins with eight labels. No file of level 0, 1 or 2 is larger.
  constexpr std::size_t kMaxFile_bytes = dted::kHeaderBytes + 3601 * dted::record_bytes(3601) + kMaxLabel_bytes;
  std::vector<std::byte>& bytes = reading_buffers().file;
  if (const auto read = read_file(path, kMaxFile_bytes, bytes); !read) return tl::unexpected(read.error());
  return parse_dted(bytes, path.string(), corner);
}

namespace {

// A header record: text fields at fixed offsets, blanks elsewhere.
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

// Appends UHL, DSI and ACC. Offsets of the fields: MIL-PRF-89020B.
void append_header(const Cell& cell, int level, std::vector<std::byte>& bytes) {
  const std::string longitude_interval = padded(dted::kTenthsPerDegree / (cell.columns() - 1), 4);
  const std::string latitude_interval = padded(dted::kTenthsPerDegree / (cell.rows() - 1), 4);
  HeaderText user(dted::kUserHeaderBytes);
  user.put(0, "UHL1");
  user.put(4, longitude_field(cell.corner().west_deg));
  user.put(12, latitude_field(cell.corner().south_deg));
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
  description.put(289, "00");  // partial cell indicator: the cell is complete
  description.append_to(bytes);
  HeaderText accuracy(dted::kAccuracyBytes);
  accuracy.put(0, "ACCNA  NA  NA  NA  ");
  accuracy.put(55, "00");
  accuracy.append_to(bytes);
}

std::uint16_t sign_magnitude_word(std::int16_t post_m) {
  if (post_m == kVoidPost) return dted::kVoidWord;
  return static_cast<std::uint16_t>(post_m < 0 ? 0x8000 | -post_m : post_m);
}

void append_column(const Cell& cell, int column, std::vector<std::byte>& bytes) {
  const std::size_t start = bytes.size();
  const auto number = static_cast<std::uint16_t>(column);
  // The count of records has three bytes. Its high byte, 0, shares the first word with the sentinel. Its low bytes are
  // the second word.
  memory::append_big_endian(static_cast<std::uint16_t>(dted::kRecordSentinel << 8U), bytes);
  memory::append_big_endian(number, bytes);
  memory::append_big_endian(number, bytes);            // longitude index
  memory::append_big_endian(std::uint16_t{0}, bytes);  // latitude index
  for (int row = 0; row < cell.rows(); ++row)
    memory::append_big_endian(sign_magnitude_word(cell.post(row, column)), bytes);
  std::uint32_t sum = 0;
  for (std::size_t at = start; at < bytes.size(); ++at) sum += std::to_integer<std::uint32_t>(bytes[at]);
  memory::append_big_endian(sum, bytes);
}

}  // namespace

std::string dted_name(CellCorner corner, int level) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%c%03d/%c%02d.dt%d", corner.west_deg < 0 ? 'w' : 'e',
                std::abs(corner.west_deg), corner.south_deg < 0 ? 's' : 'n', std::abs(corner.south_deg), level);
  return name.data();
}

int dted_columns(CellCorner corner, int level) {
  return (dted::kPostsOfLevel[level] - 1) / dted::zone_factor(corner.south_deg) + 1;
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

error::Expected<std::filesystem::path> write_dted(const std::filesystem::path& tree, const Cell& cell, int level) {
  return file::write_file_and_folders(tree / dted_name(cell.corner(), level), dted_bytes(cell, level));
}

}  // namespace yars::model::terrain
