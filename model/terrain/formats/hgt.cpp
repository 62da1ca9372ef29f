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
#include "lib/file/file_search.hpp"
#include "lib/file/output_file.hpp"
#include "lib/memory/byte_order.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::model::terrain {

namespace {
constexpr int kPosts[] = {1201, 3601};  // posts along an edge, 3 and 1 arc seconds apart
constexpr std::size_t bytes_of(int posts) {
  return 2 * static_cast<std::size_t>(posts) * static_cast<std::size_t>(posts);
}
constexpr std::size_t kMaxHgt_bytes = bytes_of(kPosts[1]);
}  // namespace

int hgt_posts_for_size(std::uintmax_t bytes) {
  for (const int posts : kPosts)
    if (bytes == bytes_of(posts)) return posts;
  return 0;
}

error::Expected<CellReading> parse_hgt(std::span<const std::byte> bytes, const std::string& subject,
                                       CellCorner corner) {
  const int posts = hgt_posts_for_size(bytes.size());
  if (posts == 0)
    return error::fail(
        subject,
        "an HGT file of " + std::to_string(bytes_of(kPosts[0])) + " or " + text::counted(bytes_of(kPosts[1]), "byte"),
        text::counted(bytes.size(), "byte"), "the file is truncated or is not HGT; fetch it again");
  const auto side = static_cast<std::size_t>(posts);
  std::vector<std::int16_t>& heights = reading_buffers().posts;
  heights.resize(side * side);
  for (std::size_t row = 0; row < side; ++row)
    memory::copy_big_endian(&bytes[2 * row * side], std::span(heights).subspan((side - 1 - row) * side, side));
  std::vector<std::string> warnings;
  void_impossible_heights(heights, warnings);
  return CellReading{Cell(corner, posts, posts, heights), std::nullopt, std::move(warnings)};
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
                     text::counted(*length, "byte"), "this is no compressed HGT cell");
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

error::Expected<std::vector<std::byte>> inflate_gzip(const std::filesystem::path& path) {
  if (const auto length = compressed_length(path); !length) return tl::unexpected(length.error());
  const std::filesystem::path inside = file::lower_case(name_in_gzip(path));
  if (inside.extension() == ".hgt" && inside.filename() != file::lower_case(path.stem().string()))
    return error::fail(path.string(), path.stem().string() + " as the name in the gzip header",
                       quoted(printable(inside.filename().string())), "give the file the name of the cell in it");
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

// The entry with the archive's name without `.zip`, in any folder of the archive, in upper or lower case; nullopt if
// there is none. For the error message, `other` then receives the name of another entry, preferably of an `.hgt` file.
std::optional<ZipEntry> hgt_entry(zip_t* archive, const std::filesystem::path& path, std::string* other = nullptr) {
  const std::string entry_name = file::lower_case(path.stem().string());
  for (zip_int64_t index = 0; index < zip_get_num_entries(archive, 0); ++index) {
    zip_stat_t status;
    if (zip_stat_index(archive, static_cast<zip_uint64_t>(index), 0, &status) != 0) continue;
    if ((status.valid & ZIP_STAT_NAME) == 0 || (status.valid & ZIP_STAT_SIZE) == 0) continue;
    const std::filesystem::path name = file::lower_case(status.name);
    const ZipEntry entry{static_cast<zip_uint64_t>(index), status.size};
    if (name.filename() == entry_name) return entry;
    const bool is_hgt = name.extension() == ".hgt";
    if (other != nullptr && (other->empty() || is_hgt)) *other = printable(name.filename().string());
  }
  return std::nullopt;
}

error::Expected<ZipArchive> open_zip(const std::filesystem::path& path) {
  if (const auto length = compressed_length(path); !length) return tl::unexpected(length.error());
  int code = 0;
  ZipArchive archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive) return error::fail(path.string(), "a zip archive", "a damaged one", kFetchAgain);
  return archive;
}

error::Expected<std::vector<std::byte>> inflate_zip(const std::filesystem::path& path) {
  const auto archive = open_zip(path);
  if (!archive) return tl::unexpected(archive.error());
  std::string other;
  const std::optional<ZipEntry> entry = hgt_entry(archive->get(), path, &other);
  if (!entry)
    return error::fail(path.string(), "an entry " + path.stem().string(),
                       other.empty() ? "an archive without entries" : quoted(other),
                       "give the archive the name of the cell that is in it");
  if (hgt_posts_for_size(entry->bytes) == 0)
    return error::fail(path.string(), "an entry of 2884802 or 25934402 bytes",
                       "one of " + text::counted(entry->bytes, "byte"), "this is no HGT cell");
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

error::Expected<CellReading> read_compressed_hgt(const std::filesystem::path& path, CellCorner corner) {
  const auto bytes = is_gzip(path) ? inflate_gzip(path) : inflate_zip(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_hgt(*bytes, path.string(), corner);
}

int compressed_hgt_posts(const std::filesystem::path& path) {
  if (is_gzip(path)) {
    // A gzip stream has at least 18 bytes: header and trailer. The last 4 bytes are the uncompressed length,
    // little-endian.
    const auto length = file_length(path);
    if (!length || *length < 18) return 0;
    const auto tail = read_file_part(path, *length - 4, 4);
    if (!tail) return 0;
    return hgt_posts_for_size(memory::little_endian<std::uint32_t>(*tail, 0));
  }
  const auto archive = open_zip(path);
  if (!archive) return 0;
  const std::optional<ZipEntry> entry = hgt_entry(archive->get(), path);
  return entry ? hgt_posts_for_size(entry->bytes) : 0;
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

error::Expected<std::filesystem::path> write_hgt(const std::filesystem::path& tree, const Cell& cell) {
  return file::write_file_and_folders(tree / hgt_name(cell.corner()), hgt_bytes(cell));
}

}  // namespace yars::model::terrain
