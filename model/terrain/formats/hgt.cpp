#include "model/terrain/formats/hgt.hpp"

#include <zip.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"
#include "lib/file/text_file.hpp"
#include "lib/memory/byte_order.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::model::terrain {

namespace {
constexpr GridSize kGrids[] = {{1201, 1201}, {3601, 3601}, {3601, 1801}};  // rows, columns
constexpr std::size_t bytes_of(GridSize grid) {
  return 2 * static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns);
}
constexpr std::size_t kMaxHgt_bytes = bytes_of(kGrids[1]);

// "1201 x 1201 posts (2884802 bytes), ..."
std::string grids_text() {
  std::string text;
  for (const GridSize grid : kGrids)
    text += (text.empty() ? "" : ", ") + std::to_string(grid.columns) + " x " + std::to_string(grid.rows) + " posts (" +
            text::counted(bytes_of(grid), "byte") + ")";
  return text;
}
}  // namespace

GridSize hgt_grid_for_size(std::uintmax_t bytes) {
  for (const GridSize grid : kGrids)
    if (bytes == bytes_of(grid)) return grid;
  return {};
}

std::optional<CellCorner> corner_in_name(std::string_view name) {
  const auto letter = [&](std::size_t at) {
    return at < name.size() ? std::tolower(static_cast<unsigned char>(name[at])) : 0;
  };
  const auto degrees = [&](std::size_t at, std::size_t digits) {
    int value = 0;
    for (std::size_t i = at; i < at + digits; ++i) {
      if (letter(i) < '0' || letter(i) > '9') return -1;
      value = value * 10 + (letter(i) - '0');
    }
    return value;
  };
  std::optional<CellCorner> found;
  for (std::size_t at = 0; at < name.size(); ++at) {
    if ((letter(at) != 'n' && letter(at) != 's') || (at > 0 && std::isalnum(letter(at - 1)) != 0)) continue;
    const std::size_t east = at + (letter(at + 3) == '_' ? 4 : 3);
    if ((letter(east) != 'e' && letter(east) != 'w') || (letter(east + 4) >= '0' && letter(east + 4) <= '9')) continue;
    const int latitude_deg = degrees(at + 1, 2), longitude_deg = degrees(east + 1, 3);
    if (latitude_deg < 0 || longitude_deg < 0) continue;
    const CellCorner corner{letter(at) == 'n' ? latitude_deg : -latitude_deg,
                            letter(east) == 'e' ? longitude_deg : -longitude_deg};
    if (corner.south_deg < -90 || corner.south_deg > 89 || corner.west_deg < -180 || corner.west_deg > 179) continue;
    if (found && !(*found == corner)) return std::nullopt;
    found = corner;
  }
  return found;
}

error::Expected<CellReading> parse_hgt(std::span<const std::byte> bytes, const std::string& subject,
                                       CellCorner corner) {
  const GridSize grid = hgt_grid_for_size(bytes.size());
  if (grid.rows == 0)
    return error::fail(subject, "an HGT file of " + grids_text(), text::counted(bytes.size(), "byte"),
                       "the file is truncated or is not HGT; fetch it again");
  const auto rows = static_cast<std::size_t>(grid.rows), columns = static_cast<std::size_t>(grid.columns);
  std::vector<std::int16_t>& heights = reading_buffers().posts;
  heights.resize(rows * columns);
  for (std::size_t row = 0; row < rows; ++row)
    memory::copy_big_endian(&bytes[2 * row * columns], std::span(heights).subspan((rows - 1 - row) * columns, columns));
  std::vector<std::string> warnings;
  void_impossible_heights(heights, warnings);
  return CellReading{Cell(corner, grid.rows, grid.columns, heights), std::nullopt, std::move(warnings)};
}

error::Expected<CellReading> read_hgt(const std::filesystem::path& path, CellCorner corner) {
  std::vector<std::byte>& bytes = reading_buffers().file;
  if (const auto read = read_file(path, kMaxHgt_bytes, bytes); !read) return tl::unexpected(read.error());
  return parse_hgt(bytes, path.string(), corner);
}

namespace {

constexpr std::size_t kMaxCompressedBytes = 64UL << 20U;  // [bytes] more than any compressed cell has
constexpr const char* kFetchAgain = "fetch the file again";

std::string quoted(std::string text) {
  text.insert(text.begin(), '\'');
  text.push_back('\'');
  return text;
}

struct CloseGzip {
  void operator()(gzFile file) const { gzclose_r(file); }
};
struct DiscardZip {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseZipEntry {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using ZipArchive = std::unique_ptr<zip_t, DiscardZip>;

std::string printable(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, '?');
  return text;
}

bool is_gzip(const std::filesystem::path& path) {
  return file::lower_case(path.extension().string()) == ".gz";
}

error::Expected<std::uintmax_t> compressed_length(const std::filesystem::path& path) {
  auto length = file_length(path);
  if (!length || *length <= kMaxCompressedBytes) return length;
  return error::fail(path.string(), "at most " + text::counted(kMaxCompressedBytes, "byte"),
                     text::counted(*length, "byte"), "unpack it");
}

// The original file name in the gzip header (RFC 1952, flag FNAME); empty if the header has none.
std::string name_in_gzip(const std::filesystem::path& path) {
  constexpr std::size_t kHeadBytes = 10;     // fixed part of the header; optional fields and the name follow
  constexpr unsigned kExtra = 4, kName = 8;  // flags, RFC 1952
  const auto length = file_length(path);
  // A name that extends beyond the first 512 bytes is cut off.
  const auto head = length ? read_file_part(path, 0, std::min<std::uintmax_t>(*length, 512))
                           : error::Expected<std::vector<std::byte>>{};
  if (!head || head->size() < kHeadBytes) return {};
  const auto at = [&](std::size_t byte) { return std::to_integer<unsigned>((*head)[byte]); };
  if (at(0) != 0x1f || at(1) != 0x8b || (at(3) & kName) == 0) return {};
  std::size_t start = kHeadBytes;
  if ((at(3) & kExtra) != 0) {
    if (head->size() < start + 2) return {};
    start += 2 + at(start) + 256 * at(start + 1);
  }
  std::string name;
  for (std::size_t byte = start; byte < head->size() && at(byte) != 0; ++byte)
    name.push_back(static_cast<char>(at(byte)));
  return name;
}

error::Expected<std::vector<std::byte>> inflate_gzip(const std::filesystem::path& path, CellCorner corner) {
  if (const auto length = compressed_length(path); !length) return tl::unexpected(length.error());
  const std::string inside = name_in_gzip(path);
  if (const auto stated = corner_in_name(inside); stated && !(*stated == corner))
    return error::fail(path.string(), hgt_name(corner) + " as the name in the gzip header",
                       quoted(printable(std::filesystem::path(inside).filename().string())),
                       "give the file the name of the cell in it");
  const std::unique_ptr<gzFile_s, CloseGzip> file(gzopen(path.c_str(), "rb"));
  if (!file) return error::fail(path.string(), "a gzip file", "one that cannot be opened");
  // One byte more than the largest cell, to detect a longer stream.
  std::vector<std::byte> bytes(kMaxHgt_bytes + 1);
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const int got = gzread(file.get(), bytes.data() + filled, static_cast<unsigned>(bytes.size() - filled));
    if (got < 0) return error::fail(path.string(), "a whole gzip stream", "a damaged one", kFetchAgain);
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  int status = Z_OK;
  gzerror(file.get(), &status);
  if (status != Z_OK) return error::fail(path.string(), "a whole gzip stream", "a truncated one", kFetchAgain);
  if (filled > kMaxHgt_bytes)
    return error::fail(path.string(), "at most " + std::to_string(kMaxHgt_bytes) + " bytes unpacked", "more",
                       "this is no HGT cell");
  bytes.resize(filled);
  return bytes;
}

struct ZipEntry {
  zip_uint64_t index = 0;
  zip_uint64_t bytes = 0;
};

// Files beside those of a Mac begin with ._ and hold no heights.
bool is_hgt_name(const std::string& name) {
  return std::filesystem::path(file::lower_case(name)).extension() == ".hgt" && !name.starts_with("._");
}

// Calls `each` with the name and the entry of each file in an archive.
template <class Each>
void for_entries(zip_t* archive, const Each& each) {
  for (zip_int64_t index = 0; index < zip_get_num_entries(archive, 0); ++index) {
    zip_stat_t status;
    if (zip_stat_index(archive, static_cast<zip_uint64_t>(index), 0, &status) != 0) continue;
    if ((status.valid & ZIP_STAT_NAME) == 0 || (status.valid & ZIP_STAT_SIZE) == 0) continue;
    each(std::filesystem::path(status.name).filename().string(),
         ZipEntry{static_cast<zip_uint64_t>(index), status.size});
  }
}

// The first HGT file of a cell, in any folder of the archive; nullopt if there is none. For the error message, `other`
// then receives the name of another entry, preferably of an `.hgt` file.
std::optional<ZipEntry> hgt_entry(zip_t* archive, CellCorner corner, std::string* other = nullptr) {
  std::optional<ZipEntry> found;
  for_entries(archive, [&](const std::string& name, ZipEntry entry) {
    const bool is_hgt = is_hgt_name(name);
    if (!found && is_hgt && corner_in_name(name) == corner) found = entry;
    if (other != nullptr && (other->empty() || is_hgt)) *other = printable(name);
  });
  return found;
}

error::Expected<ZipArchive> open_zip(const std::filesystem::path& path) {
  if (const auto length = compressed_length(path); !length) return tl::unexpected(length.error());
  int code = 0;
  ZipArchive archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive) return error::fail(path.string(), "a zip archive", "a damaged one", kFetchAgain);
  return archive;
}

error::Expected<std::vector<std::byte>> inflate_zip(const std::filesystem::path& path, CellCorner corner) {
  const auto archive = open_zip(path);
  if (!archive) return tl::unexpected(archive.error());
  std::string other;
  const std::optional<ZipEntry> entry = hgt_entry(archive->get(), corner, &other);
  if (!entry)
    return error::fail(path.string(), "an entry " + hgt_name(corner),
                       other.empty() ? "an archive without entries" : quoted(other),
                       "give the archive the name of the cell that is in it");
  if (hgt_grid_for_size(entry->bytes).rows == 0)
    return error::fail(path.string(), "an entry of " + grids_text(), "one of " + text::counted(entry->bytes, "byte"),
                       "this is no HGT cell");
  const std::unique_ptr<zip_file_t, CloseZipEntry> file(zip_fopen_index(archive->get(), entry->index, 0));
  if (!file) return error::fail(path.string(), "an entry that can be unpacked", zip_strerror(archive->get()));
  std::vector<std::byte> bytes(entry->bytes);
  const zip_int64_t got = zip_fread(file.get(), bytes.data(), bytes.size());
  // libzip compares the checksum when a read reaches the end of the entry. The extra byte also detects a longer entry.
  std::byte beyond{};
  if (got != static_cast<zip_int64_t>(bytes.size()) || zip_fread(file.get(), &beyond, 1) != 0)
    return error::fail(path.string(), "a whole entry with its checksum", "a damaged one", kFetchAgain);
  return bytes;
}

}  // namespace

error::Expected<PackedFiles> packed_hgt_files(const std::filesystem::path& path) {
  PackedFiles files;
  std::string unplaced;
  const auto add = [&](const std::string& name, std::optional<CellCorner> corner) {
    if (!corner)
      unplaced = name;
    else if (std::find(files.cells.begin(), files.cells.end(), *corner) == files.cells.end())
      files.cells.push_back(*corner);
  };
  if (is_gzip(path)) {
    const std::string inside = std::filesystem::path(name_in_gzip(path)).filename().string();
    const std::string own = path.stem().string();
    const auto stated = corner_in_name(inside);
    if (is_hgt_name(inside) || is_hgt_name(own))
      add(printable(own), stated ? stated : corner_in_name(own));
    else
      files.others.push_back(own);
  } else {
    const auto archive = open_zip(path);
    if (!archive) return tl::unexpected(archive.error());
    for_entries(archive->get(), [&](const std::string& name, ZipEntry /*entry*/) {
      if (is_hgt_name(name))
        add(printable(name), corner_in_name(name));
      else
        files.others.push_back(printable(name));
    });
  }
  if (unplaced.empty()) return files;
  return error::fail(path.string(), "HGT files whose names state their cells, as N36W122.hgt", quoted(unplaced),
                     "unpack it and give the file the name of its cell");
}

error::Expected<CellReading> read_compressed_hgt(const std::filesystem::path& path, CellCorner corner) {
  const auto bytes = is_gzip(path) ? inflate_gzip(path, corner) : inflate_zip(path, corner);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_hgt(*bytes, path.string(), corner);
}

GridSize compressed_hgt_grid(const std::filesystem::path& path, CellCorner corner) {
  if (is_gzip(path)) {
    // A gzip stream has at least 18 bytes: header and trailer. The last 4 bytes are the uncompressed length,
    // little-endian.
    const auto length = file_length(path);
    if (!length || *length < 18) return {};
    const auto tail = read_file_part(path, *length - 4, 4);
    if (!tail) return {};
    return hgt_grid_for_size(memory::little_endian<std::uint32_t>(*tail, 0));
  }
  const auto archive = open_zip(path);
  if (!archive) return {};
  const std::optional<ZipEntry> entry = hgt_entry(archive->get(), corner);
  return entry ? hgt_grid_for_size(entry->bytes) : GridSize{};
}

std::string hgt_name(CellCorner corner) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%c%02d%c%03d.hgt", corner.south_deg < 0 ? 'S' : 'N',
                std::abs(corner.south_deg), corner.west_deg < 0 ? 'W' : 'E', std::abs(corner.west_deg));
  return name.data();
}

std::vector<std::byte> hgt_bytes(const Cell& cell) {
  const std::size_t size = 2 * static_cast<std::size_t>(cell.rows()) * static_cast<std::size_t>(cell.columns());
  YARS_REQUIRE(cell.unit_m(), ==, 1.0);
  YARS_REQUIRE(cell.rows(), ==, cell.columns());
  YARS_REQUIRE(hgt_grid_for_size(size).rows, ==, cell.rows());
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

error::Expected<std::filesystem::path> write_hgt(const std::filesystem::path& tree, const Cell& cell) {
  return file::write_file_and_folders(tree / hgt_name(cell.corner()), hgt_bytes(cell));
}

}  // namespace yars::model::terrain
