// DTED levels 0, 1 and 2: layout, reader, writer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain::dted {

// The layout of DTED levels 0, 1 and 2, shared by reader and writer. Source: MIL-PRF-89020B 3.11 and 3.12.
inline constexpr std::size_t kUserHeaderBytes = 80;    // UHL
inline constexpr std::size_t kDescriptionBytes = 648;  // DSI
inline constexpr std::size_t kVerticalDatumAt = 141;   // in DSI
inline constexpr std::size_t kVerticalDatumBytes = 3;
inline constexpr std::size_t kHorizontalDatumAt = 144;
inline constexpr std::size_t kHorizontalDatumBytes = 5;
inline constexpr std::size_t kAccuracyBytes = 2700;  // ACC
inline constexpr std::size_t kHeaderBytes = kUserHeaderBytes + kDescriptionBytes + kAccuracyBytes;
inline constexpr std::size_t kRecordHeadBytes = 8;  // sentinel, count, longitude and latitude index
inline constexpr std::size_t kRecordSumBytes = 4;   // sum of the bytes before it
inline constexpr std::size_t kLabelBytes = 80;      // VOL and HDR labels of a tape, before UHL
inline constexpr std::uint8_t kRecordSentinel = 0xAA;
inline constexpr std::uint16_t kVoidWord = 0xFFFF;         // -32767 in sign-magnitude
inline constexpr int kPostsOfLevel[] = {121, 1201, 3601};  // posts along a meridian, by level
inline constexpr int kTenthsPerDegree = 36000;             // intervals are in tenths of an arc second

// Posts along a parallel are spaced this many times wider than along a meridian (zones I to V).
constexpr int zone_factor(int south_deg) {
  const int nearest_equator_deg = south_deg >= 0 ? south_deg : -south_deg - 1;
  if (nearest_equator_deg < 50) return 1;
  if (nearest_equator_deg < 70) return 2;
  if (nearest_equator_deg < 75) return 3;
  return nearest_equator_deg < 80 ? 4 : 6;
}

constexpr std::size_t record_bytes(int posts) {
  return kRecordHeadBytes + 2 * static_cast<std::size_t>(posts) + kRecordSumBytes;
}

}  // namespace yars::model::terrain::dted

namespace yars::model::terrain {

// Reads one DTED cell of level 0, 1 or 2 (MIL-PRF-89020B). Counts in the file are believed only as far as its
// length bears them out. Voids become kVoidPost; absent columns and absent ends of columns too, with a warning.
// A wrong column checksum is a warning and the heights stand (project choice: most such files are merely old).
// Files written in two's complement (heights that sign-magnitude would put below -16000 m) are read as such.
// Datums: WGS84 and mean sea level (MSL, E84, E96, E08); blank counts as these. Others are refused, WGS72 too.
// Errors: no UHL, another datum, origin not in whole degrees or not `place`, posts that do not span one degree, a torn
// record.
error::Expected<CellReading> read_dted(const std::filesystem::path& path, CellPlace place);

// The same from memory; `subject` names the file in errors.
error::Expected<CellReading> parse_dted(std::span<const std::byte> bytes, const std::string& subject, CellPlace place);

// Writes a cell as DTED level 0, 1 or 2 (MIL-PRF-89020B): whole columns, sign-magnitude, right checksums.
// Errors of write_dted: the file cannot be written. The cell needs kPostsOfLevel[level] rows.
std::vector<std::byte> dted_bytes(const Cell& cell, int level);

// `tree`/wLLL/nBB.dtN, written as lib/file/output_file.hpp says; folders are made.
error::Expected<std::filesystem::path> write_dted(const std::filesystem::path& tree, const Cell& cell, int level);

// Below a tree: "w122/n36.dt1".
std::string dted_name(CellPlace place, int level);

// Columns of a cell of that level: fewer toward the poles.
int dted_columns(CellPlace place, int level);

}  // namespace yars::model::terrain
