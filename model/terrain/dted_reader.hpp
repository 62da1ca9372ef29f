// Reads one DTED cell of level 0, 1 or 2 (MIL-PRF-89020B). Counts in the file are believed only as far as its
// length bears them out. Voids become kVoidPost; absent columns and absent ends of columns too, with a warning.
// A wrong column checksum is a warning and the heights stand (project choice: most such files are merely old).
// Files written in two's complement (heights that sign-magnitude would put below -16000 m) are read as such.
// Datums: WGS84 and mean sea level (MSL, E84, E96, E08); blank counts as these. Others are refused, WGS72 too.
// Errors: no UHL, another datum, origin not in whole degrees or not `place`, posts that do not span one degree, a torn
// record.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "model/terrain/cell_reading.hpp"

namespace yars::model::terrain {

failure::Expected<CellReading> read_dted(const std::filesystem::path& path, CellPlace place);

// The same from memory; `subject` names the file in errors.
failure::Expected<CellReading> parse_dted(std::span<const std::byte> bytes, const std::string& subject,
                                          CellPlace place);

}  // namespace yars::model::terrain
