// DTED (digital terrain elevation data), levels 0, 1 and 2: layout, reader, writer.
// Input: a file, or its bytes; a cell to write. Output: a CellReading; a file.
// Units: whole metres above mean sea level. Frame: WGS84, assumed if the file names no datum; other datums are errors.
// Source: MIL-PRF-89020B 3.11 and 3.12; docs/spec/formats.md#dted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain::dted {

// Layout, shared by reader and writer: offsets and lengths in bytes.
inline constexpr std::size_t kUserHeaderBytes = 80;    // user header label (UHL)
inline constexpr std::size_t kDescriptionBytes = 648;  // data set identification (DSI)
inline constexpr std::size_t kVerticalDatumAt = 141;   // offset in DSI
inline constexpr std::size_t kVerticalDatumBytes = 3;
inline constexpr std::size_t kHorizontalDatumAt = 144;
inline constexpr std::size_t kHorizontalDatumBytes = 5;
inline constexpr std::size_t kAccuracyBytes = 2700;  // accuracy description (ACC)
inline constexpr std::size_t kHeaderBytes = kUserHeaderBytes + kDescriptionBytes + kAccuracyBytes;
inline constexpr std::size_t kRecordHeadBytes = 8;  // sentinel, count, longitude and latitude index
inline constexpr std::size_t kRecordSumBytes = 4;   // sum of all earlier bytes of the record
inline constexpr std::size_t kLabelBytes = 80;      // VOL and HDR labels of a tape, before UHL
inline constexpr std::uint8_t kRecordSentinel = 0xAA;
inline constexpr std::uint16_t kVoidWord = 0xFFFF;         // -32767 in sign-magnitude
inline constexpr int kPostsOfLevel[] = {121, 1201, 3601};  // posts along a meridian, by level
inline constexpr int kTenthsPerDegree = 36000;             // tenths of an arc second, the unit of post spacings

// Ratio of the post spacing [deg] along a parallel to the post spacing along a meridian (DTED zones I to V), for the
// cell with the south edge `south_deg`.
constexpr int zone_factor(int south_deg) {
  const int nearest_equator_deg = south_deg >= 0 ? south_deg : -south_deg - 1;
  if (nearest_equator_deg < 50) return 1;
  if (nearest_equator_deg < 70) return 2;
  if (nearest_equator_deg < 75) return 3;
  return nearest_equator_deg < 80 ? 4 : 6;
}

// [bytes] Length of the record of one column.
constexpr std::size_t record_bytes(int posts) {
  return kRecordHeadBytes + 2 * static_cast<std::size_t>(posts) + kRecordSumBytes;
}

}  // namespace yars::model::terrain::dted

namespace yars::model::terrain {

// Place and posts of a cell, as the header of its file states them.
struct DtedPlace {
  CellCorner corner;
  GridSize grid;
};
// Reads the header of a file of any name. Errors: those of the header, see read_dted().
error::Expected<DtedPlace> dted_place(const std::filesystem::path& path);

// True if a file begins as DTED does, with the label of a header or of a tape.
bool begins_as_dted(const std::filesystem::path& path);

// Reads one cell. Voids become kVoidPost. So do impossible heights (cell_reading.hpp), with a warning.
// Absent columns, and posts that are absent at the south end of a column, become voids with a warning.
// A wrong column checksum is a warning, and the heights are kept (project choice).
// A file with a height below -16000 m in sign-magnitude is read as two's complement, with a note.
// Datums: horizontal WGS84 or blank; vertical MSL, E84, E96, E08 (mean sea level of EGM84, EGM96, EGM2008) or blank.
// Any other datum, such as WGS72, is an error.
// Errors: no UHL, another datum, an origin not in whole degrees or not at `corner`, posts that do not span one
// degree, a truncated or misplaced record.
error::Expected<CellReading> read_dted(const std::filesystem::path& path, CellCorner corner);

// Checks the datums of a description record (DSI). Blanks and null characters in the fields are ignored.
// Errors: a datum that read_dted() does not accept. `subject` names the file in errors.
error::Expected<void> check_dted_datums(std::string_view vertical, std::string_view horizontal,
                                        const std::string& subject);

// Like read_dted(), but from the bytes of a file. `subject` names the file in errors.
error::Expected<CellReading> parse_dted(std::span<const std::byte> bytes, const std::string& subject,
                                        CellCorner corner);

// Returns the bytes of a DTED file: whole columns, heights in sign-magnitude, with checksums.
// Requires kPostsOfLevel[level] rows and posts in units of 1 m.
std::vector<std::byte> dted_bytes(const Cell& cell, int level);

// Writes the file dted_name() in the folder `tree` (see lib/file/output_file.hpp), creates missing folders and returns
// the path.
error::Expected<std::filesystem::path> write_dted(const std::filesystem::path& tree, const Cell& cell, int level);

// Path of a cell's file relative to the folder `tree`: "w122/n36.dt1".
std::string dted_name(CellCorner corner, int level);

// Number of columns of a cell at a level, by the DTED zone of its latitude.
int dted_columns(CellCorner corner, int level);

}  // namespace yars::model::terrain
