#include "model/terrain/formats/pack_side.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/memory/byte_order.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "model/terrain/formats/jpeg2000.hpp"

namespace yars::model::terrain {

namespace {

constexpr std::string_view kMagic = "YARSSIDE";
constexpr std::uint32_t kVersion = 1;           // posts in metres
constexpr std::uint32_t kVersionWithUnit = 2;   // the last four bytes give the unit of the posts
constexpr std::size_t kHeadBytes = 36;          // length of the header, up to and including the number of levels
constexpr std::size_t kChecksumAt = 28;         // offset of the checksum over all following bytes
constexpr std::size_t kLevelBytes = 12;         // length of an entry in the table of levels
constexpr double kUnitsPerMetre = 100.0;        // the file gives the unit of the posts in centimetres
constexpr std::uint32_t kMaxStoredLevels = 17;  // more mean a damaged file; pack_cell() writes at most 6

// Numbers of posts along the sides of a grid.
struct Sides {
  int rows = 0;
  int columns = 0;
  std::size_t posts() const { return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
};

Sides reduced(Sides sides, int reduction) {
  return {reduced_posts(sides.rows, reduction), reduced_posts(sides.columns, reduction)};
}

std::uint32_t checksum(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

// Sizes and counts are written as 32 bits.
void append_32(std::size_t value, std::vector<std::byte>& bytes) {
  memory::append_big_endian(static_cast<std::uint32_t>(value), bytes);
}
void append(std::span<const std::byte> more, std::vector<std::byte>& bytes) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

// Appends one bit per post: 1 where the post equals `value`.
void append_bits(const Cell& cell, std::int16_t value, std::vector<std::byte>& bytes) {
  const std::size_t start = bytes.size();
  std::size_t post = 0;
  for (int row = 0; row < cell.rows(); ++row)
    for (int column = 0; column < cell.columns(); ++column, ++post) {
      if (post % 8 == 0) bytes.push_back(std::byte{0});
      if (cell.post(row, column) == value) bytes[start + post / 8] |= std::byte{0x80} >> (post % 8);
    }
}

void append_edges(const Cell& cell, std::vector<std::byte>& bytes) {
  for (const int row : {0, cell.rows() - 1})
    for (int column = 0; column < cell.columns(); ++column) memory::append_big_endian(cell.post(row, column), bytes);
  for (const int column : {0, cell.columns() - 1})
    for (int row = 0; row < cell.rows(); ++row) memory::append_big_endian(cell.post(row, column), bytes);
}

std::size_t bit_bytes(Sides sides) {
  return (sides.posts() + 7) / 8;
}
// [bytes] Uncompressed length of the marks of a reduction (pack_side.hpp).
std::size_t mark_bytes(Sides sides, int reduction) {
  if (reduction == 0) return bit_bytes(sides);
  return 3 * bit_bytes(sides) + 4 * static_cast<std::size_t>(sides.rows + sides.columns);
}

std::vector<std::byte> deflated(std::span<const std::byte> bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> compressed(size);
  const int status = compress2(reinterpret_cast<Bytef*>(compressed.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_COMPRESSION);
  YARS_REQUIRE(status, ==, Z_OK);
  compressed.resize(size);
  return compressed;
}

struct CompressedLevel {
  std::size_t plain_marks = 0;  // [bytes] length of the marks before compression
  std::vector<std::byte> marks;
  std::vector<std::byte> peaks;
};

error::Expected<CompressedLevel> compressed_level(const Cell& cell, int reduction) {
  std::vector<std::byte> marks;
  if (reduction == 0) {
    append_bits(cell, kVoidPost, marks);
    return CompressedLevel{marks.size(), deflated(marks), {}};
  }
  const ReducedCell level = reduce(cell, reduction);
  append_bits(level.means, kVoidPost, marks);
  append_bits(level.means, 0, marks);
  append_edges(level.means, marks);
  append_bits(level.peaks, kVoidPost, marks);
  HeightGrid grid{level.peaks.rows(), level.peaks.columns(), {}};
  for (int row = grid.rows - 1; row >= 0; --row)
    for (int column = 0; column < grid.columns; ++column) grid.heights.push_back(level.peaks.post(row, column));
  fill_voids(grid);
  // At most 5 wavelet levels, as in pack.cpp.
  auto peaks = encode_jpeg2000(grid, std::min({halvings(grid.rows), halvings(grid.columns), 5}));
  if (!peaks) return tl::unexpected(peaks.error());
  return CompressedLevel{marks.size(), deflated(marks), std::move(*peaks)};
}

// Reads successive 32-bit words. Requires that the words are within the buffer.
class Words {
 public:
  explicit Words(const std::byte* at) : at_(at) {}
  std::uint32_t next() { return memory::big_endian<std::uint32_t>(std::exchange(at_, at_ + 4)); }

 private:
  const std::byte* at_;
};

// [m] Unit of the posts; 0 if the file states 0 or more than 100 cm.
double unit_of(std::span<const std::byte> side) {
  if (memory::big_endian<std::uint32_t>(side.data() + kMagic.size()) == kVersion) return 1.0;
  const std::uint32_t centimetres = memory::big_endian<std::uint32_t>(side.data() + side.size() - 4);
  return centimetres <= 100 ? centimetres / kUnitsPerMetre : 0.0;
}

// take_bits() and take_edge() read from the front of `bytes` and remove what they have read.
std::vector<bool> take_bits(std::span<const std::byte>& bytes, Sides sides) {
  std::vector<bool> bits(sides.posts());
  for (std::size_t post = 0; post < bits.size(); ++post)
    bits[post] = (bytes[post / 8] & (std::byte{0x80} >> (post % 8))) != std::byte{0};
  bytes = bytes.subspan(bit_bytes(sides));
  return bits;
}

std::vector<std::int16_t> take_edge(std::span<const std::byte>& bytes, int posts) {
  std::vector<std::int16_t> edge;
  for (std::size_t i = 0; i < static_cast<std::size_t>(posts); ++i)
    edge.push_back(memory::big_endian<std::int16_t>(&bytes[2 * i]));
  bytes = bytes.subspan(2 * static_cast<std::size_t>(posts));
  return edge;
}

error::Expected<std::vector<std::byte>> inflated(std::span<const std::byte> compressed, std::size_t bytes,
                                                 const std::string& subject) {
  std::vector<std::byte> plain(bytes);
  uLongf size = bytes;
  const int status = uncompress(reinterpret_cast<Bytef*>(plain.data()), &size,
                                reinterpret_cast<const Bytef*>(compressed.data()), compressed.size());
  if (status != Z_OK || size != bytes)
    return error::fail(subject, std::to_string(bytes) + " bytes of masks and edges", "damaged data",
                       "pack the cell again");
  return plain;
}

// Position and grid of a reduced cell.
struct CellFrame {
  CellCorner corner;
  Sides sides;
  double unit_m;
};

error::Expected<Cell> parse_peaks(std::span<const std::byte> compressed, const std::vector<bool>& voids,
                                  const CellFrame& frame, const std::string& subject) {
  const Sides sides = frame.sides;
  const auto grid = decode_jpeg2000(compressed, subject, sides.rows, sides.columns, 0);
  if (!grid) return tl::unexpected(grid.error());
  const auto columns = static_cast<std::ptrdiff_t>(sides.columns);
  std::vector<std::int16_t> posts;
  posts.reserve(sides.posts());
  for (std::ptrdiff_t row = sides.rows - 1; row >= 0; --row)
    posts.insert(posts.end(), grid->heights.begin() + row * columns, grid->heights.begin() + (row + 1) * columns);
  for (std::size_t post = 0; post < posts.size(); ++post)
    if (voids[post]) posts[post] = kVoidPost;
  return Cell(frame.corner, sides.rows, sides.columns, posts, frame.unit_m);
}

}  // namespace

error::Expected<std::vector<std::byte>> side_bytes(const Cell& cell, int reductions, std::span<const std::byte> jp2) {
  std::vector<CompressedLevel> levels;
  for (int reduction = 0; reduction <= reductions; ++reduction) {
    auto level = compressed_level(cell, reduction);
    if (!level) return tl::unexpected(level.error());
    levels.push_back(std::move(*level));
  }
  std::vector<std::byte> body;
  append_32(levels.size(), body);
  for (const CompressedLevel& level : levels)
    for (const std::size_t size : {level.plain_marks, level.marks.size(), level.peaks.size()}) append_32(size, body);
  for (const CompressedLevel& level : levels) {
    append(level.marks, body);
    append(level.peaks, body);
  }
  const bool metres = cell.unit_m() == 1.0;
  if (!metres) append_32(static_cast<std::size_t>(std::lround(cell.unit_m() * kUnitsPerMetre)), body);
  std::vector<std::byte> side;
  for (const char letter : kMagic) side.push_back(static_cast<std::byte>(letter));
  append_32(metres ? kVersion : kVersionWithUnit, side);
  append_32(static_cast<std::size_t>(cell.rows()), side);
  append_32(static_cast<std::size_t>(cell.columns()), side);
  append_32(jp2.size(), side);
  append_32(checksum(jp2), side);
  append_32(checksum(body), side);
  append(body, side);
  return side;
}

error::Expected<SideHead> parse_side_head(std::span<const std::byte> side, std::span<const std::byte> jp2,
                                          const std::string& subject) {
  const auto invalid = [&](const std::string& expected, const std::string& found) {
    return error::fail(subject, expected, found, "pack the cell again");
  };
  if (side.size() < kHeadBytes || std::string_view(reinterpret_cast<const char*>(side.data()), 8) != kMagic)
    return invalid("the side file of a packed cell (YARSSIDE)", "other bytes");
  Words words(side.data() + kMagic.size());
  if (const std::uint32_t version = words.next(); version != kVersion && version != kVersionWithUnit)
    return invalid("version 1 or 2", "version " + std::to_string(version));
  const std::uint32_t rows = words.next();
  const std::uint32_t columns = words.next();
  const std::uint32_t jp2_bytes = words.next();
  const std::uint32_t jp2_sum = words.next();
  if (jp2_bytes != jp2.size() || jp2_sum != checksum(jp2))
    return invalid("the side file of the .jp2 beside it", "the side file of another .jp2, or a damaged .jp2");
  if (words.next() != checksum(side.subspan(kChecksumAt + 4))) return invalid("a whole side file", "a wrong checksum");
  const std::uint32_t levels = words.next();
  if (rows < 2 || columns < 2 || rows > kMaxEdgePosts || columns > kMaxEdgePosts || levels == 0 ||
      levels > kMaxStoredLevels || kHeadBytes + levels * kLevelBytes > side.size())
    return invalid("2 to 7201 posts a side and 1 to 17 levels", std::to_string(columns) + " x " + std::to_string(rows) +
                                                                    " posts, " + std::to_string(levels) + " levels");
  const double unit_m = unit_of(side);
  if (unit_m <= 0.0) return invalid("posts in a unit of 1 to 100 cm", "another unit");
  return SideHead{static_cast<int>(rows), static_cast<int>(columns), static_cast<int>(levels) - 1, unit_m};
}

error::Expected<SideLevel> parse_side_level(std::span<const std::byte> side, CellCorner corner, int reduction,
                                            const std::string& subject) {
  Words words(side.data() + kMagic.size() + 4);
  const int rows = static_cast<int>(words.next());
  const int columns = static_cast<int>(words.next());
  const std::size_t levels = memory::big_endian<std::uint32_t>(side.data() + kHeadBytes - 4);
  const Sides sides = reduced({rows, columns}, reduction);
  Words table(side.data() + kHeadBytes);
  std::size_t at = kHeadBytes + levels * kLevelBytes;
  for (int before = 0; before < reduction; ++before) {
    table.next();
    at += table.next();
    at += table.next();
  }
  const std::size_t plain = table.next();
  const std::size_t marks = table.next();
  const std::size_t peaks = table.next();
  if (plain != mark_bytes(sides, reduction) || at > side.size() || marks > side.size() - at ||
      peaks > side.size() - at - marks)
    return error::fail(subject, "sections inside the file", "a section beyond its end", "pack the cell again");
  const auto unpacked = inflated(side.subspan(at, marks), plain, subject);
  if (!unpacked) return tl::unexpected(unpacked.error());
  std::span<const std::byte> rest = *unpacked;
  SideLevel level{take_bits(rest, sides), {}, {}, std::nullopt};
  if (reduction == 0) return level;
  level.sea = take_bits(rest, sides);
  for (std::size_t edge = 0; edge < level.edges.size(); ++edge)
    level.edges[edge] = take_edge(rest, edge < 2 ? sides.columns : sides.rows);
  auto peak_cell =
      parse_peaks(side.subspan(at + marks, peaks), take_bits(rest, sides), {corner, sides, unit_of(side)}, subject);
  if (!peak_cell) return tl::unexpected(peak_cell.error());
  level.peaks = std::move(*peak_cell);
  return level;
}

}  // namespace yars::model::terrain
