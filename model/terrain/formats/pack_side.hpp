// Side file of a packed cell (pack.hpp), such as n36.side: masks of voids and sea, edges and peaks of each reduction.
// Reduction r is the grid of every 2^r-th post; a peak is the highest ground around one of its posts (cell.hpp).
// The edges equal those of reduce(), so that neighbouring cells agree. Each reduction can be read alone.
// Layout, big-endian: "YARSSIDE"; one u32 each: version, rows, columns, length and CRC-32 of the .jp2, CRC-32 of all
// following bytes, highest reduction + 1; for each reduction from 0 {u32 bytes of marks, u32 bytes of compressed
// marks, u32 bytes of peaks}; for each reduction the marks (zlib) and the peaks (JPEG 2000); in version 2 also u32 unit
// of the posts [cm]. In version 1 the unit is the metre. The marks of a reduction are, in this order: one bit
// per post, 1 if the post is void; from reduction 1 on also one bit per post, 1 if the post is sea; the posts of the
// edges (i16: south, north, west, east); one bit per peak, 1 if the peak is void. Bits run row by row from
// the south, highest bit first.
// Errors: wrong magic number, version or checksum, sizes beyond the file's length, a .jp2 with another checksum.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::terrain {

// Content of the side file for one reduction of a cell, as made by reduce(). Reduction 0 has voids only.
struct SideLevel {
  std::vector<bool> voids;                         // one value for each post, row by row from the south
  std::vector<bool> sea;                           // in the same order; empty at reduction 0
  std::array<std::vector<std::int16_t>, 4> edges;  // [unit of the posts] south and north row, west and east column
  std::optional<Cell> peaks;                       // ReducedCell::peaks; nullopt at reduction 0
};

// Returns the bytes of the side file that belongs to `jp2`, with the reductions 0 to `reductions`. Errors: the
// JPEG 2000 encoder fails.
error::Expected<std::vector<std::byte>> side_bytes(const Cell& cell, int reductions, std::span<const std::byte> jp2);

// Header of a side file, with the unit of its posts. Rows and columns are those of reduction 0.
struct SideHead {
  int rows = 0;
  int columns = 0;
  int reductions = 0;   // highest reduction in the file
  double unit_m = 1.0;  // [m] height of post value 1
};

// Checks header, checksums and sizes, but not the contents of a level.
// Errors: another magic or version, damage, a side file of another .jp2.
error::Expected<SideHead> parse_side_head(std::span<const std::byte> side, std::span<const std::byte> jp2,
                                          const std::string& subject);

// Reads one reduction. Requires a file that parse_side_head() accepted, and reduction <= SideHead::reductions.
// Errors: a damaged section.
error::Expected<SideLevel> parse_side_level(std::span<const std::byte> side, CellCorner corner, int reduction,
                                            const std::string& subject);

}  // namespace yars::model::terrain
