// Reads an SRTM cell out of `N36W122.hgt.zip` (the entry of that name; case does not matter) or `N36W122.hgt.gz`
// (whose own note of a name, if it has one, is that too).
// Only an entry that is as long as an HGT file is unpacked, and never more than that: a bomb is an error.
// Errors: a damaged archive, no such entry, another length; else those of hgt_reader.hpp.
#pragma once

#include <filesystem>

#include "model/terrain/cell_reading.hpp"

namespace yars::model::terrain {

failure::Expected<CellReading> read_packed_hgt(const std::filesystem::path& path, CellPlace place);

// Posts a side by the length that the archive states; 0 when it states none that an HGT file has.
int packed_hgt_posts(const std::filesystem::path& path);

}  // namespace yars::model::terrain
