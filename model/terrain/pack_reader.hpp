// Reads a packed cell (see pack_writer.hpp) at a reduction. At 0 it is the packed cell bit for bit. Above, finer
// levels are not decoded: inside the cell heights are the wavelet's low-pass, at most the peak, in place of reduce()'s
// box mean (sharper: rms 4 to 22 m apart in 3-arc-second mountains at reductions 1 and 2); edges, voids, sea and peaks
// are those of reduce(). A reduction beyond what the cell holds gives its coarsest.
// Errors: one of the two files is missing, damaged, or belongs to another.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "model/terrain/cell_reading.hpp"
#include "model/terrain/jpeg2000.hpp"

namespace yars::model::terrain {

failure::Expected<CellReading> read_pack(const std::filesystem::path& path, CellPlace place, int reduction);

// The same from memory; `subject` names the file in errors.
failure::Expected<CellReading> parse_pack(std::span<const std::byte> jp2, std::span<const std::byte> side,
                                          const std::string& subject, CellPlace place, int reduction);

// Posts a side of the packed cell by the head of the .jp2; zeros when it has none.
GridSize pack_size(const std::filesystem::path& path);

}  // namespace yars::model::terrain
