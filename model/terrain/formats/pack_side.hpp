// What stands beside a packed cell, in `nBB.side`: what its wavelet cannot say. For each reduction: which posts are
// void and which are sea, the four edges as reduce() makes them (so that neighbours agree), and the peaks. A reader
// of one reduction unpacks that one only. The checksum of the .jp2 ties both files together.
// Layout, big-endian: "YARSSIDE", u32 version, rows, columns, bytes and CRC-32 of the .jp2, CRC-32 of all that
// follows, u32 reductions + 1; for each {u32 bytes of marks unpacked, u32 bytes of marks, u32 bytes of peaks}; then
// for each the marks (zlib) and the peaks (JPEG 2000); in version 2, last, u32 centimetres of a unit of the posts,
// which are metres in version 1. Marks: bits of void posts; from reduction 1 on bits of sea posts, edges (i16: south,
// north, west, east), bits of void peaks. Bits lie eight a byte, the first the highest, row by row from the south.
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

// One reduction of a cell, as reduce() gives it; reduction 0 has neither sea nor edges nor peaks.
struct SideLevel {
  std::vector<bool> voids;  // by post, row by row from the south
  std::vector<bool> sea;
  std::array<std::vector<std::int16_t>, 4> edges;  // [m] south and north row, west and east column
  std::optional<Cell> peaks;
};

// `jp2` is the file that it will stand beside. Errors: the coder fails.
error::Expected<std::vector<std::byte>> side_bytes(const Cell& cell, int reductions, std::span<const std::byte> jp2);

struct SideHead {
  int rows = 0;
  int columns = 0;
  int reductions = 0;
  double unit_m = 1.0;  // [m] of a post
};

// Checks all but the level's own contents. Errors: another magic or version, damage, a side of another .jp2.
error::Expected<SideHead> parse_side_head(std::span<const std::byte> side, std::span<const std::byte> jp2,
                                          const std::string& subject);

// Requires a side that parse_side_head() accepted and reduction <= its reductions.
error::Expected<SideLevel> parse_side_level(std::span<const std::byte> side, CellPlace place, int reduction,
                                            const std::string& subject);

}  // namespace yars::model::terrain
