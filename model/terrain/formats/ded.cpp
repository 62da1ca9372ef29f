#include "model/terrain/formats/ded.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "lib/memory/byte_order.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::model::terrain {

namespace {

constexpr std::size_t kHeaderBytes = 128;
constexpr std::size_t kStatisticsBytes = 32;
constexpr std::size_t kFrontBytes = kHeaderBytes + kStatisticsBytes;  // before the table of cells
constexpr std::size_t kCellHeaderBytes = 40;
constexpr std::uint32_t kCellsOfEarth = kCellRows * kCellColumns;
constexpr double kTenthsPerDegree = 36000;   // tenths of an arc second, the unit of the spacings in the file
constexpr double kEdgeTolerance_deg = 1e-4;  // [deg] tolerance of an edge; a float resolves 180 degrees to 1.5e-5 deg
constexpr double kSpanTolerance = 1e-3;      // [deg] tolerance of (posts - 1) * spacing; the file rounds spacings

double real_at(const std::byte* bytes) {
  return static_cast<double>(memory::big_endian<float>(bytes));
}

// The integer that is within `tolerance` of `value` and in [min, max]. nullopt if there is no such integer, or for NaN.
std::optional<int> whole(double value, double tolerance, int min, int max) {
  if (!(value >= min - 0.5 && value <= max + 0.5)) return std::nullopt;
  const int nearest = static_cast<int>(std::lround(value));
  if (std::abs(value - nearest) > tolerance || nearest < min || nearest > max) return std::nullopt;
  return nearest;
}

std::string as_text(double value) {
  return std::to_string(value);
}

// Number of cells that the header states, checked against the file's length.
error::Expected<std::size_t> cells_announced(std::span<const std::byte> front, std::uintmax_t file_bytes,
                                             const std::string& subject) {
  const std::string_view text(reinterpret_cast<const char*>(front.data()), kHeaderBytes);
  const std::string_view kind = text.substr(8, 4);
  if (memory::big_endian<std::uint32_t>(front.data()) != kHeaderBytes || text.substr(4, 4) != "SSYS" ||
      (kind != "DMA1" && kind != "DED1"))
    return error::fail(subject, "a MultiGen DED file (SSYS, DMA1 or DED1)", "other bytes");
  const std::uint32_t cells = memory::big_endian<std::uint32_t>(front.data() + kHeaderBytes);
  if (cells == 0 || cells > kCellsOfEarth)
    return error::fail(subject, "1 to " + std::to_string(kCellsOfEarth) + " cells", std::to_string(cells));
  if (kFrontBytes + cells * kCellHeaderBytes > file_bytes)
    return error::fail(subject, "headers of " + std::to_string(cells) + " cells",
                       std::to_string(file_bytes) + " bytes in all", "the file is truncated; fetch it again");
  return cells;
}

// Parses one entry of the table of cells: south, north, west, east [deg]; spacing in latitude, longitude [0.1 arc
// second]; posts in latitude, longitude. `number` counts from 1, for messages.
error::Expected<DedCell> parse_cell(const std::byte* header, std::size_t number, const std::string& subject) {
  const std::string which = "cell " + std::to_string(number);
  const double south = real_at(header);
  const double north = real_at(header + 4);
  const double west = real_at(header + 8);
  const double east = real_at(header + 12);
  const auto south_deg = whole(south, kEdgeTolerance_deg, -90, 89);
  const auto west_deg = whole(west, kEdgeTolerance_deg, -180, 179);
  if (!south_deg || !west_deg || !(std::abs(north - south - 1.0) < kEdgeTolerance_deg) ||
      !(std::abs(east - west - 1.0) < kEdgeTolerance_deg))
    return error::fail(subject, which + " from one whole degree to the next",
                       "latitude " + as_text(south) + " to " + as_text(north) + ", longitude " + as_text(west) +
                           " to " + as_text(east),
                       "export the file again, with cells cut at whole degrees");
  const auto rows = whole(real_at(header + 24), 0.0, 2, kMaxEdgePosts);
  const auto columns = whole(real_at(header + 28), 0.0, 2, kMaxEdgePosts);
  const auto fits = [](int posts, double spacing) {
    return std::abs((posts - 1) * spacing / kTenthsPerDegree - 1.0) < kSpanTolerance;
  };
  if (!rows || !columns || !fits(*rows, real_at(header + 16)) || !fits(*columns, real_at(header + 20)))
    return error::fail(
        subject, which + " with posts that span one degree, 2 to " + std::to_string(kMaxEdgePosts) + " a side",
        as_text(real_at(header + 24)) + " x " + as_text(real_at(header + 28)) + " posts at " +
            as_text(real_at(header + 16)) + " x " + as_text(real_at(header + 20)) + " tenths of a second");
  return DedCell{{*south_deg, *west_deg}, *rows, *columns, 0};
}

// Parses the table of cells, and checks the length of the file against the cells' posts.
error::Expected<std::vector<DedCell>> parse_table(std::span<const std::byte> table, std::uintmax_t file_bytes,
                                                  const std::string& subject) {
  std::vector<DedCell> cells;
  std::uint64_t offset = kFrontBytes + table.size();
  for (std::size_t at = 0; at < table.size(); at += kCellHeaderBytes) {
    auto cell = parse_cell(table.data() + at, cells.size() + 1, subject);
    if (!cell) return tl::unexpected(cell.error());
    cell->offset = offset;
    offset += cell->bytes();
    cells.push_back(*cell);
  }
  if (offset != file_bytes)
    return error::fail(subject, std::to_string(offset) + " bytes for " + std::to_string(cells.size()) + " cells",
                       text::counted(file_bytes, "byte"), "the file is truncated or damaged; fetch it again");
  return cells;
}

error::Expected<DedCell> cell_at(const std::vector<DedCell>& cells, CellCorner corner, const std::string& subject) {
  const auto cell =
      std::find_if(cells.begin(), cells.end(), [&](const DedCell& each) { return each.corner == corner; });
  if (cell != cells.end()) return *cell;
  return error::fail(
      subject,
      "a cell with the south-west corner " + std::to_string(corner.south_deg) + ", " + std::to_string(corner.west_deg),
      std::to_string(cells.size()) + " other cells");
}

CellReading decode(const DedCell& cell, std::span<const std::byte> bytes) {
  std::vector<std::int16_t>& posts = reading_buffers().posts;
  posts.resize(bytes.size() / 2);
  const auto rows = static_cast<std::size_t>(cell.rows);
  const auto columns = static_cast<std::size_t>(cell.columns);
  for (std::size_t column = 0; column < columns; ++column)
    for (std::size_t row = 0; row < rows; ++row) {
      const auto height_m = memory::big_endian<std::int16_t>(&bytes[2 * (column * rows + row)]);
      posts[row * columns + column] = height_m <= -32767 ? kVoidPost : height_m;
    }
  std::vector<std::string> warnings;
  void_impossible_heights(posts, warnings);
  return {Cell(cell.corner, cell.rows, cell.columns, posts), std::nullopt, std::move(warnings)};
}

}  // namespace

error::Expected<std::vector<DedCell>> ded_cells(const std::filesystem::path& path) {
  const std::string subject = path.string();
  const auto length = file_length(path);
  if (!length) return tl::unexpected(length.error());
  const auto front = read_file_part(path, 0, kFrontBytes);
  if (!front) return tl::unexpected(front.error());
  const auto count = cells_announced(*front, *length, subject);
  if (!count) return tl::unexpected(count.error());
  const auto table = read_file_part(path, kFrontBytes, *count * kCellHeaderBytes);
  if (!table) return tl::unexpected(table.error());
  return parse_table(*table, *length, subject);
}

error::Expected<CellReading> read_ded(const std::filesystem::path& path, CellCorner corner) {
  const auto cells = ded_cells(path);
  if (!cells) return tl::unexpected(cells.error());
  const auto cell = cell_at(*cells, corner, path.string());
  if (!cell) return tl::unexpected(cell.error());
  const auto bytes = read_file_part(path, cell->offset, cell->bytes());
  if (!bytes) return tl::unexpected(bytes.error());
  return decode(*cell, *bytes);
}

}  // namespace yars::model::terrain
